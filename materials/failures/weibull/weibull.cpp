// The strength of springs has a Weibull distribution. A base spring breaks when its strain passes
// its own limit,
//   e = scale [least + (1 - least) (-ln p)^(1 / modulus)]
// with p uniform between 0 and 1, from the seed and the two particles of the spring. The fraction
// of springs with a limit below e is
//   1 - exp(-((e / scale - least) / (1 - least))^modulus).
// A scene has the same strengths in every run, with any number of threads.
#include <hyperlattice/chance.hpp>
#include <hyperlattice/failure.hpp>

#include <cmath>

namespace {
using namespace hyperlattice;

class Weibull {
 public:
  struct Options {
    double scale = 0, modulus = 0, least = 0;
    std::int64_t seed = 0;
  };

  static Schema<Options> schema() {
    return Schema<Options>(
               "failures.weibull",
               "A spring breaks when its strain passes a limit that scatters from spring to spring")
        .equation(
            "(|r| - |r0|) / |r0| > scale (least + (1 - least) (-ln p)^(1 / modulus)), p from the "
            "seed and the spring's particles")
        .source("Weibull 1951, three parameters")
        .restrictions(
            "springs above the least strain are reviewed at every step: a run with a least far "
            "below the strains that occur is slower. Strengths "
            "belong "
            "to springs, not to places: another spacing or another shape has others")
        .add<&Options::scale>("scale", "", "strain below which 63 % of all springs break")
        .example("1e-3")
        .positive()
        .add<&Options::modulus>("modulus", "", "of Weibull: large ones scatter little")
        .example("5")
        .positive()
        .add<&Options::least>(
            "least", "",
            "share of scale below which no spring breaks; 0: Weibull with two parameters")
        .at_least(0)
        .below(1)
        .add<&Options::seed>("seed", "", "of the strengths")
        .at_least(0)
        .at_most(1LL << 53)
        .fallback("1");
  }

  explicit Weibull(const Options& options) : o_(options) {}

  double alarm(const SpringFacts& spring) const { return o_.scale * o_.least * spring.rest_length; }
  bool breaks(const SpringFacts& spring, const AlarmedSpring& state) const {
    const double limit =
        o_.scale *
        (o_.least + (1 - o_.least) * std::pow(-std::log(chance(static_cast<std::uint64_t>(o_.seed),
                                                               state.a, state.b)),
                                              1 / o_.modulus));
    return state.elongation > limit * spring.rest_length;
  }

 private:
  Options o_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Weibull>(); }
