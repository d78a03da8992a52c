// Damage starts at a limit of the equivalent stress of von Mises, whatever the pressure:
//   ratio = sqrt(3 J2) / strength
// Tension and compression have one strength, and strength in shear is strength / sqrt(3).
#include <hyperlattice/strength_surface.hpp>

namespace {
using namespace hyperlattice;

class VonMises {
 public:
  using Options = CohesiveOptions;

  static Schema<Options> schema() {
    Schema<Options> schema("failures.von_mises",
                           "Damage that starts at a limit of the equivalent stress of von Mises");
    return CohesiveOptions::declare(schema)
        .equation("ratio = sqrt(3 J2) / strength")
        .source("von Mises 1913; damage: Wu 2017");
  }

  explicit VonMises(const Options& options) : strength_(options.strength) {}

  double ratio(const PrincipalStress& stress) const { return stress.von_mises() / strength_; }

 private:
  double strength_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<VonMises>(); }
