// A base spring breaks in tension when its stored energy passes a limit:
//   k (|r| - |r0|)^2 / 2 > U
// U is given, or follows from the energy G_c of a unit of crack area:
//   U = G_c / n,  n = (sum of the rest lengths of the springs in a unit of volume) / 2
// where n is the number of base springs that pass through a unit of area, in the mean over all
// directions of the area. So a crack needs the same energy at any spacing. On the cubic lattice
// n = (3 + 6 sqrt 2) / (2 l^2) = 5.74 / l^2; a crack along {100} crosses 5 / l^2. Cross springs
// add the energy that they store.
#include <hyperlattice/failure.hpp>

#include <cmath>

namespace {
using namespace hyperlattice;

class Energy {
 public:
  struct Options {
    std::optional<double> limit, fracture_energy;
  };

  static Schema<Options> schema() {
    return Schema<Options>("failures.energy",
                           "A spring breaks when it stores more than an energy, given or by the "
                           "fracture energy")
        .equation(
            "u_n > 0 and k u_n^2 / 2 > limit, or > fracture_energy / n with n springs through a "
            "unit of area")
        .restrictions(
            "for linear springs. At once and for good: the strength that goes with a fracture "
            "energy falls as the root of the spacing")
        .add<&Options::limit>("limit", "J", "energy that breaks a base spring")
        .example("\"2 uJ\"")
        .positive()
        .add<&Options::fracture_energy>("fracture_energy", "J/m2",
                                        "G_c: energy of the base springs through a unit of crack "
                                        "area, mean over all directions")
        .positive()
        .check([](const Options& o, const FaultSink& faults) {
          if (o.limit.has_value() == o.fracture_energy.has_value())
            faults.fault("limit", "exactly one of limit and fracture_energy");
        });
  }

  explicit Energy(const Options& options) : o_(options) {}

  double alarm(const SpringFacts& spring) const {
    return spring.stiffness > 0 ? std::sqrt(2 * energy(spring) / spring.stiffness) : infinity;
  }
  bool breaks(const SpringFacts& spring, double elongation) const {
    return elongation > 0 && 0.5 * spring.stiffness * elongation * elongation > energy(spring);
  }

 private:
  double energy(const SpringFacts& spring) const {
    return o_.limit ? *o_.limit : *o_.fracture_energy / spring.crossings;
  }

  Options o_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Energy>(); }
