// A base spring breaks when it was strained far enough for long enough. Its damage is the integral
// over time of the strain e above a threshold,
//   D = integral of max(e - threshold, 0)^exponent dt,
// and it breaks when D reaches the impulse. Damage does not heal. Each step adds its length times
// the value at its end: an error of first order in the step, and of second order for a pulse that
// begins and ends at the threshold.
#include <hyperlattice/failure.hpp>

#include <cmath>

namespace {
using namespace hyperlattice;

class TulerButcher {
 public:
  struct Options {
    double threshold = 0, exponent = 0, impulse = 0;
  };

  static Schema<Options> schema() {
    return Schema<Options>("failures.tuler_butcher",
                           "A spring breaks when its strain was above a threshold for long enough")
        .equation(
            "integral of max(e - threshold, 0)^exponent dt >= impulse, e = (|r| - |r0|) / |r0|")
        .source("Tuler and Butcher 1968, for strains in place of stresses")
        .restrictions(
            "springs above the threshold are reviewed at every step, and each keeps a number. "
            "Damage grows only in steps that advance the time, by the strain at the end of each "
            "step: not between states of rest, and not while a relaxation holds the time")
        .add<&Options::threshold>("threshold", "", "strain below which no damage grows")
        .example("1e-3")
        .positive()
        .add<&Options::exponent>("exponent", "",
                                 "lambda of Tuler and Butcher: a large one lets high strains count "
                                 "more than long times")
        .positive()
        .fallback("2")
        .add<&Options::impulse>("impulse", "s",
                                "K: integral of the strain above the threshold, to the power "
                                "exponent, that breaks a base spring")
        .example("\"1 ns\"")
        .positive();
  }

  explicit TulerButcher(const Options& options) : o_(options) {}

  struct Memory {
    double damage = 0;  ///< D, s
  };
  double alarm(const SpringFacts& spring) const { return o_.threshold * spring.rest_length; }
  bool breaks(const SpringFacts& spring, const AlarmedSpring& state, Memory& memory) const {
    const double above = state.elongation / spring.rest_length - o_.threshold;
    if (above > 0) memory.damage += std::pow(above, o_.exponent) * state.time_step;
    return memory.damage >= o_.impulse;
  }

 private:
  Options o_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<TulerButcher>(); }
