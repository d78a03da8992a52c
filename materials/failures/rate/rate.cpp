// A base spring breaks when its strain e passes a limit that grows with the strain rate e':
//   e > limit [1 + (max(e', 0) / reference)^(1 / exponent)]
#include <hyperlattice/failure.hpp>

#include <algorithm>
#include <cmath>

namespace {
using namespace hyperlattice;

class Rate {
 public:
  struct Options {
    double limit = 0, reference = 0, exponent = 0;
  };

  static Schema<Options> schema() {
    return Schema<Options>(
               "failures.rate",
               "A spring breaks when its strain passes a limit that grows with the rate of strain")
        .equation(
            "e = (|r| - |r0|) / |r0| > limit (1 + (max(de/dt, 0) / reference)^(1 / exponent))")
        .source("Cowper and Symonds 1957, for strains in place of stresses")
        .restrictions(
            "the rate is that of half a step before. The stiffness does "
            "not depend on the rate")
        .add<&Options::limit>("limit", "", "strain that breaks a base spring that is pulled slowly")
        .example("1e-3")
        .positive()
        .add<&Options::reference>("reference", "1/s",
                                  "rate of strain at which the limit is twice as large")
        .positive()
        .add<&Options::exponent>("exponent", "", "q of Cowper and Symonds")
        .positive()
        .fallback("1");
  }

  explicit Rate(const Options& options) : o_(options) {}

  static constexpr bool asks_rate = true;
  double alarm(const SpringFacts& spring) const { return o_.limit * spring.rest_length; }
  bool breaks(const SpringFacts& spring, const AlarmedSpring& state) const {
    const double rate = std::max(state.rate, 0.0) / spring.rest_length;
    return state.elongation >
           o_.limit * spring.rest_length * (1 + std::pow(rate / o_.reference, 1 / o_.exponent));
  }

 private:
  Options o_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Rate>(); }
