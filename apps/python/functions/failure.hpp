// A failure criterion that a Python function decides, about all springs at once.
#pragma once

#include "function_options.hpp"

namespace hyperlattice::python {

class Failure {
 public:
  struct Options : FunctionOptions {
    std::optional<double> above, above_strain;
  };

  static Schema<Options> schema() {
    Schema<Options> schema("failures.python", "Springs break where a Python function says so");
    schema.equation("function(springs)")
        .source(
            "the function of the scene. It gets arrays of elongations, rest lengths, rates and "
            "ends, and returns a boolean for each spring")
        .restrictions(
            "Python is called in every step, after a pass over all springs, which is slow beside "
            "a built-in criterion. Only for scenes that Python runs")
        .add<&Options::above>("above", "m",
                              "the function is asked only about springs that are longer by more "
                              "than this; left out: about all springs")
        .add<&Options::above_strain>("above_strain", "",
                                     "the same for the elongation over the rest length")
        .at_least(-1);
    return add_function_options(schema, "decides which springs break")
        .check([](const Options& options, const FaultSink& faults) {
          check_function(options, faults);
          if (options.above && options.above_strain)
            faults.fault("above", "either above or above_strain");
        });
  }

  explicit Failure(const Options& options) : o_(options), function_(found(options)) {}

  double alarm(const SpringFacts& spring) const {
    if (o_.above) return *o_.above;
    return o_.above_strain.value_or(-1) * spring.rest_length;
  }
  void breaks(const SpringArrays& springs, std::span<std::uint8_t> broken) const {
    function_->set_broken(springs, broken);
  }

 private:
  Options o_;
  std::shared_ptr<PythonFunction> function_;
};

}  // namespace hyperlattice::python
