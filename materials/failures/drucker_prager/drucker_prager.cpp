// The limit of Drucker and Prager: pressure raises the limit of the shear. With the strengths T in
// uniaxial tension and C in uniaxial compression
//   ratio = a sqrt(3 J2) + b I1,   a = (1 / T + 1 / C) / 2,   b = (1 / T - 1 / C) / 2.
// The surface is a cone. It has strengths 2 / (sqrt(3) (1 / T + 1 / C)) in shear,
// 1 / (1 / T + b) in equal biaxial tension and 1 / (3 b) under tension from all sides.
#include <hyperlattice/strength_surface.hpp>

#include <algorithm>

namespace {
using namespace hyperlattice;

class DruckerPrager {
 public:
  struct Options : CohesiveOptions {
    double compressive_strength = 0;
  };

  static Schema<Options> schema() {
    Schema<Options> schema(
        "failures.drucker_prager",
        "Damage that starts at a limit of the shear stress which rises with pressure");
    return CohesiveOptions::declare(schema)
        .add<&Options::compressive_strength>("compressive_strength", "Pa",
                                             "C, strength in uniaxial compression")
        .positive()
        .example("\"40 MPa\"")
        .equation(
            "ratio = (1 / strength + 1 / compressive_strength) sqrt(3 J2) / 2 + (1 / strength - 1 "
            "/ compressive_strength) I1 / 2; 0 where that is negative")
        .source("Drucker and Prager 1952; damage: Wu 2017")
        .check([](const Options& o, const FaultSink& faults) {
          if (o.compressive_strength < o.strength)
            faults.fault("compressive_strength", "at least the strength in tension");
        });
  }

  explicit DruckerPrager(const Options& o)
      : shear_((1 / o.strength + 1 / o.compressive_strength) / 2),
        pressure_((1 / o.strength - 1 / o.compressive_strength) / 2) {}

  double ratio(const PrincipalStress& stress) const {
    return std::max(0.0, shear_ * stress.von_mises() + pressure_ * stress.trace());
  }

 private:
  double shear_, pressure_;  // 1/Pa
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<DruckerPrager>(); }
