// The strength of brittle solids: in tension a limit of the largest principal stress (Rankine);
// with a compressive strength also a limit of the shear on inclined planes, which friction raises
// (Mohr-Coulomb with tension cut-off):
//   ratio = max(<s1> / sigma_t, (N s1 - s3) / C),   N = (1 + sin phi) / (1 - sin phi)
// In uniaxial compression the second term is 1 at C. N = C / sigma_t makes it one at sigma_t in
// uniaxial tension too; a larger N would break there below sigma_t.
#include <hyperlattice/strength_surface.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {
using namespace hyperlattice;

/// Returns N, the slope of the limit of s3 by s1. `friction`: angle, radians.
double slope(double friction) { return (1 + std::sin(friction)) / (1 - std::sin(friction)); }

class Cohesive {
 public:
  struct Options : CohesiveOptions {
    std::optional<double> compressive_strength, friction_angle;
  };

  static Schema<Options> schema() {
    Schema<Options> schema(
        "failures.cohesive",
        "Damage that softens springs, from strength and fracture energy: cracks of brittle solids");
    CohesiveOptions::declare(schema)
        .add<&Options::compressive_strength>(
            "compressive_strength", "Pa",
            "C, strength in uniaxial compression; left out: compression alone breaks nothing")
        .positive()
        .add<&Options::friction_angle>(
            "friction_angle", "rad",
            "phi: compression across a plane resists its sliding by tan phi. With a compressive "
            "strength only; left out: that of N = C / sigma_t")
        .at_least(0)
        .below(std::numbers::pi / 2)
        .check([](const Options& o, const FaultSink& faults) {
          if (!o.compressive_strength) {
            if (o.friction_angle)
              faults.fault("friction_angle", "a compressive_strength beside it");
            return;
          }
          if (*o.compressive_strength < o.strength)
            faults.fault("compressive_strength", "at least the strength in tension");
          else if (o.friction_angle &&
                   slope(*o.friction_angle) > *o.compressive_strength / o.strength * (1 + 1e-12))
            faults.fault("friction_angle",
                         "an angle phi with (1 + sin phi) / (1 - sin phi) of at most "
                         "compressive_strength / strength: else shear breaks below the strength");
        });
    return schema
        .equation(
            "ratio = max(<s1> / strength, (N s1 - s3) / compressive_strength), "
            "N = (1 + sin friction_angle) / (1 - sin friction_angle); principal stresses s1, s3")
        .source("damage: Wu 2017; surface: Rankine 1857, Mohr 1900 with tension cut-off");
  }

  explicit Cohesive(const Options& o)
      : tension_(o.strength),
        compression_(o.compressive_strength.value_or(infinity)),
        slope_(o.friction_angle ? slope(*o.friction_angle)
                                : o.compressive_strength.value_or(0) / o.strength) {}

  double ratio(const PrincipalStress& stress) const {
    return std::max(
        {0.0, stress.first / tension_, (slope_ * stress.first - stress.third) / compression_});
  }

 private:
  double tension_, compression_, slope_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Cohesive>(); }
