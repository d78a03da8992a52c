// A base spring breaks when a condition holds, which the scene writes as an expression:
//   "when": "strain > 1e-3 && strain_rate < critical", "constants": ["critical = 10 1/s"]
// The condition is compiled once. A spring is asked only above the elongation below which interval
// arithmetic shows the condition to be false.
#include "alarm.hpp"

#include <quantities/constants.hpp>

#include <hyperlattice/failure.hpp>

#include <array>

namespace {
using namespace hyperlattice;
namespace inputs = hyperlattice::spring_condition;

class Condition {
 public:
  struct Options {
    std::string when;
    std::vector<std::string> constants;
  };

  static Schema<Options> schema() {
    return Schema<Options>("failures.expression",
                           "A spring breaks when a condition of its own holds")
        .equation("when")
        .source(
            "the names `strain` (elongation over rest length), `elongation` (m), `strain_rate` "
            "(1/s) and `rate` (m/s) of half a step before, `force` (N; stiffness times "
            "elongation), `time` (s), `rest_length` (m), `stiffness` (N/m), `spacing` (m), pi and "
            "the constants; numbers with or without a unit; the operators `+ - * / ^ < <= > >= == "
            "!= && || ?:` and the functions of loads.expression. Dimensions are checked")
        .restrictions(
            "the force is that of a linear spring. A spring is asked in a step only if it is "
            "longer than an elongation up to which the condition is certainly false; interval "
            "arithmetic finds it. `strain > 1e-3` costs as much as failures.strain. A condition "
            "that may hold for any elongation, such as `time > 1 ms` or `abs(strain) > 1e-3`, asks "
            "about every spring in every step, and steps take some twenty times as long")
        .add<&Options::when>("when", "", "condition at which a base spring breaks")
        .example("\"strain > 1e-3\"")
        .add<&Options::constants>(
            "constants", "",
            "names for quantities, such as \"critical = 10 1/s\"; each may use "
            "those before it")
        .fallback("[]")
        .check([](const Options& options, const FaultSink& faults) {
          std::string problem;
          const auto names = names_of(options, problem);
          if (!problem.empty()) return faults.fault("constants", problem);
          if (const Expression read = compile(options, names); !read.problem.empty())
            faults.fault("when", "a condition of a spring, such as strain > 1e-3; " + read.problem);
          else if (!read.is_condition)
            faults.fault("when", "a condition of a spring, such as strain > 1e-3, and no number");
        });
  }

  explicit Condition(const Options& options) : condition_(compiled(options)), alarm_(condition_) {}

  static constexpr bool asks_rate = true;
  double alarm(const SpringFacts& spring) const { return alarm_.of(spring); }
  bool breaks(const SpringFacts& spring, const AlarmedSpring& state) const {
    const std::array<double, inputs::input_count> values{state.elongation,
                                                         state.elongation / spring.rest_length,
                                                         state.rate,
                                                         state.rate / spring.rest_length,
                                                         spring.stiffness * state.elongation,
                                                         state.time,
                                                         spring.rest_length,
                                                         spring.stiffness,
                                                         spring.spacing};
    return condition_(values) != 0;
  }

 private:
  /// Returns the names that a condition may use: the inputs, in their order, and the constants.
  static std::vector<ExpressionName> names_of(const Options& options, std::string& problem) {
    std::vector<ExpressionName> names{{"elongation", {1}, {}},   {"strain", {}, {}},
                                      {"rate", {1, 0, -1}, {}},  {"strain_rate", {0, 0, -1}, {}},
                                      {"force", {1, 1, -2}, {}}, {"time", {0, 0, 1}, {}},
                                      {"rest_length", {1}, {}},  {"stiffness", {0, 1, -2}, {}},
                                      {"spacing", {1}, {}}};
    problem = add_constants(options.constants, names);
    return names;
  }

  static Expression compile(const Options& options, const std::vector<ExpressionName>& names) {
    return compile_expression(options.when, names);
  }
  /// Returns the condition of options that were checked.
  static Compiled compiled(const Options& options) {
    std::string problem;
    Expression read = compile(options, names_of(options, problem));
    if (!read.compiled || !read.is_condition) throw std::invalid_argument(read.problem);
    return std::move(*read.compiled);
  }

  Compiled condition_;
  inputs::Alarm alarm_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Condition>(); }
