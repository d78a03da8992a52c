// A law with constants, a tangent and no memory: a spring that stiffens,
//   f = k u (1 + (u / (s L))^2),
// with the elongation u, the rest length L and the strain s at which the stiffness has doubled. Its
// kernels are for one instruction set, to be compiled soon.
#define HYPERLATTICE_INSTRUCTIONS baseline
#include <hyperlattice/elastic_solid.hpp>
#include <hyperlattice/kernels/law_kernels.hpp>

struct StiffeningLaw {
  struct Constants {
    double strain;  ///< s
  };

  template <class Real>
  static Real growth(const hyperlattice::SpringOf<Real>& spring, const Constants& c) {
    const Real ratio = spring.elongation / (c.strain * spring.rest_length);
    return ratio * ratio;
  }
  template <class Real>
  static Real force(const hyperlattice::SpringOf<Real>& spring, const Constants& c) {
    return spring.stiffness * spring.elongation * (1.0 + growth(spring, c));
  }
  template <class Real>
  static Real energy(const hyperlattice::SpringOf<Real>& spring, const Constants& c) {
    return 0.5 * spring.stiffness * spring.elongation * spring.elongation *
           (1.0 + 0.5 * growth(spring, c));
  }
  template <class Real>
  static Real tangent(const hyperlattice::SpringOf<Real>& spring, const Constants& c) {
    return spring.stiffness * (1.0 + 3.0 * growth(spring, c));
  }
};
HYPERLATTICE_KERNELS(StiffeningLaw)

namespace {
using namespace hyperlattice;

class Stiffening {
 public:
  struct Options : elastic_solid::Options {
    double strain = 0;
  };
  static constexpr std::string_view law = "stiffening";

  static Schema<Options> schema() {
    Schema<Options> schema("materials.stiffening", "Springs that stiffen");
    schema.equation("f = k u (1 + (u / (strain L))^2)")
        .add<&Options::strain>("strain", "", "strain at which a spring has twice its stiffness")
        .example("0.01")
        .positive();
    return Options::declare(schema);
  }
  explicit Stiffening(const Options& options) : options_(options) {}
  MaterialConstants constants(const LatticeFacts& lattice) const {
    MaterialConstants constants = options_.constants(lattice);
    constants.set_law(StiffeningLaw::Constants{options_.strain});
    return constants;
  }
  static KernelSet kernels(const KernelChoice& choice) {
    return hyperlattice_kernels_baseline(choice);
  }

 private:
  Options options_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Stiffening>(); }
