// A viscoelastic solid whose stiffness relaxes: each spring is a standard linear solid (a spring in
// parallel with a Maxwell element). E and nu are the instantaneous values. After a long time the
// modulus is (1 - share) E, with the same Poisson ratio, because all springs relax alike. The
// stress under a strain e that is applied at once and held is
//   E (1 - share + share exp(-t / time)) e.
// share = 1 gives a Maxwell fluid.
#include "relaxing.hpp"

#include <hyperlattice/elastic_solid.hpp>
#include <hyperlattice/kernels/choose.hpp>

namespace {
using namespace hyperlattice;

class Relaxing {
 public:
  struct Options : elastic_solid::Options {
    double share = 0, time = 0;
  };

  static constexpr std::string_view law = "relaxing";

  static Schema<Options> schema() {
    Schema<Options> schema(
        "materials.relaxing",
        "Viscoelastic springs whose stiffness relaxes: the standard linear solid, or Maxwell's");
    schema
        .equation(
            "f = k (u - share w), dw/dt = (u - w) / time; under a constant strain the stress falls "
            "as 1 - share + share exp(-t / time)")
        .source(
            "standard linear solid; the damper's elongation by the exponential that is exact for a "
            "constant rate")
        .restrictions("young is the modulus at once")
        .add<&Options::share>("share", "",
                              "part of the stiffness that relaxes; 1: all of it (Maxwell)")
        .at_least(0)
        .at_most(1)
        .add<&Options::time>("time", "s", "relaxation time of the damper")
        .example("\"10 us\"")
        .positive();
    return Options::declare(schema);
  }

  explicit Relaxing(const Options& options) : options_(options) {}

  MaterialConstants constants(const LatticeFacts& lattice) const {
    MaterialConstants constants = options_.constants(lattice);
    constants.set_law(RelaxingLaw::Constants{options_.share, options_.time});
    return constants;
  }
  static KernelSet kernels(const KernelChoice& choice) { return kernels_for_processor(choice); }

 private:
  Options options_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Relaxing>(); }
