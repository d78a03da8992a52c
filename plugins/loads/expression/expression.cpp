// A load whose load factor f(t) is an expression of the time t, s, and pi, for example
// "exp(-t / 1e-3) * sin(2 * pi * 500 * t)". The load acts on particles like loads.force, or inside
// the body like loads.actuation:
//   total, each:    F_i = f(t) total w_i / (sum of w)  or  f(t) each; w_i: fraction of a particle
//   force, strain:  each base spring pushes its ends apart with f(t) force w  or  k L0 f(t) strain
//   pressure:       each face of present area A has the force -f(t) pressure A
// muParser reads the expression and evaluates it once a step.
#include <hyperlattice/watching.hpp>

#include <muParser.h>

#include <numbers>

namespace {
using namespace hyperlattice;

class Expression {
 public:
  struct Options {
    RegionId on;
    std::string expression;
    std::vector<double> corners;
    std::optional<Vec3> total, each;
    std::optional<double> force, strain, pressure;
  };

  static Schema<Options> schema() {
    return Schema<Options>("loads.expression",
                           "A force, actuation or pressure that follows an expression of time")
        .equation("f(t) times total, each, force, strain or pressure")
        .source(
            "expressions: muParser (BSD licence). They hold numbers, t, the constants pi, `_pi` "
            "and `_e`, parentheses, the "
            "operators `+ - * / ^ < <= > >= == != && || ?:`, the functions abs, sign, rint, sqrt, "
            "exp, ln, log, log2, log10, sin, "
            "cos, tan, asin, acos, atan, atan2, sinh, cosh, tanh, asinh, acosh, atanh, min, max, "
            "sum, avg, and nothing else. A "
            "comparison gives 1 or 0, a ^ b ^ c is a ^ (b ^ c), log is ln, rint rounds to a whole "
            "number, and min, max, sum and avg "
            "take any number of values")
        .restrictions(
            "the impulse is exact over the expression's kinks and jumps if `corners` says where "
            "they are; loads.actuation knows its own. f(t) must "
            "be "
            "a finite number at every step. Along springs the restrictions of loads.actuation hold")
        .add<&Options::on>("on", "", "the loaded particles, springs or surface")
        .add<&Options::expression>("expression", "",
                                   "f(t): t is the time in seconds, counted from the start of the "
                                   "run; the source below says what it may hold")
        .example("\"sin(2e5 * t)\"")
        .add<&Options::corners>("corners", "s", "instants of kinks and jumps")
        .fallback("[]")
        .add<&Options::total>(
            "total", "N",
            "shared evenly by the particles, in a body of cells by their shares of a whole one")
        .example("[\"10 N\", 0, 0]")
        .add<&Options::each>("each", "N", "on every particle")
        .add<&Options::force>("force", "N", "of each base spring; positive pushes its ends apart")
        .add<&Options::strain>("strain", "",
                               "change of rest length over rest length; positive lengthens")
        .above(-1)
        .add<&Options::pressure>("pressure", "Pa", "on moving faces; positive pushes on the body")
        .check([](const Options& o, const FaultSink& faults) {
          const int given = o.total.has_value() + o.each.has_value() + o.force.has_value() +
                            o.strain.has_value() + o.pressure.has_value();
          if (given != 1)
            faults.fault("total", "exactly one of total, each, force, strain and pressure");
        });
  }

  explicit Expression(const Options& options)
      : o_(options), actuator_{options.force, options.strain, options.pressure, {}, {}} {
    const auto refuse = [&](const std::string& why) {
      constexpr std::size_t shown = 100;
      const std::string text =
          o_.expression.size() > shown ? o_.expression.substr(0, shown) + "..." : o_.expression;
      throw std::invalid_argument("an expression of t, not \"" + text + "\": " + why);
    };
    if (o_.expression.size() > most_characters)
      refuse("it is longer than " + std::to_string(most_characters) + " characters");
    if (assigns(o_.expression)) refuse("\"=\" gives a variable another value; \"==\" compares");
    int values = 0;
    try {
      parser_.DefineVar("t", &time_);
      parser_.DefineConst("pi", std::numbers::pi);
      parser_.SetExpr(o_.expression);
      parser_.Eval(values);  // muParser reads "1,5" as a list of two values and would use the last
    } catch (const mu::Parser::exception_type& error) {
      refuse(error.GetMsg());
    }
    if (values != 1)
      refuse("it is a list of " + std::to_string(values) + " values; numbers have a decimal point");
  }

  void declare(const LoadBody& body, const LoadSink& sink) {
    for (const double corner : o_.corners) sink.corner(corner);
    if (!o_.total && !o_.each) return actuator_.declare(body, sink, o_.on);
    const std::span<const Particle> particles = body.particles(o_.on);
    double sum = 0;
    for (const Particle particle : particles) sum += body.share(particle);
    for (const Particle particle : particles)
      sink.force(particle, o_.each ? *o_.each : (body.share(particle) / sum) * *o_.total);
  }

  double factor(double time) const {
    time_ = time;
    try {
      return parser_.Eval();
    } catch (const mu::Parser::exception_type&) {
      return std::numeric_limits<double>::quiet_NaN();  // the run's guard reports it
    }
  }
  Vec3 answer(const WatchedMotion& motion, std::size_t n) const {
    return actuator_.answer(motion, n);
  }

 private:
  static constexpr std::size_t most_characters = 4000;

  static bool assigns(std::string_view text) {
    for (std::size_t n = 0; n < text.size(); ++n) {
      if (text[n] != '=') continue;
      if (text.substr(n + 1, 1) == "=")
        ++n;
      else if (n == 0 || std::string_view("<>!").find(text[n - 1]) == std::string_view::npos)
        return true;
    }
    return false;
  }

  Options o_;
  Actuator actuator_;
  mutable double time_ = 0;
  mu::Parser parser_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Expression>(); }
