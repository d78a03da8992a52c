// A law whose force is a tenth larger than the derivative of its energy. Its kernels are for one
// instruction set only, to save time of compilation.
#define HYPERLATTICE_INSTRUCTIONS baseline
#include <hyperlattice/elastic_solid.hpp>
#include <hyperlattice/kernels/law_kernels.hpp>

struct WrongLaw {
  struct Constants {
    double factor;
  };
  struct Memory {};

  static void update(const hyperlattice::SpringState&, const Constants&, Memory&) {}
  static double force(const hyperlattice::SpringState& s, const Constants& c, const Memory&) {
    return c.factor * s.stiffness * s.elongation;
  }
  static double energy(const hyperlattice::SpringState& s, const Constants&, const Memory&) {
    return 0.5 * s.stiffness * s.elongation * s.elongation;
  }
};
HYPERLATTICE_KERNELS(WrongLaw)

namespace {
using namespace hyperlattice;

class WrongForce {
 public:
  struct Options : elastic_solid::Options {};
  static constexpr std::string_view law = "wrong_force";

  static Schema<Options> schema() {
    Schema<Options> schema("materials.wrong_force",
                           "Springs whose force is not the derivative of their energy");
    return Options::declare(schema);
  }
  explicit WrongForce(const Options& options) : options_(options) {}
  MaterialConstants constants(const LatticeFacts& lattice) const {
    MaterialConstants constants = options_.constants(lattice);
    constants.set_law(WrongLaw::Constants{1.1});
    return constants;
  }
  static KernelSet kernels(const KernelChoice& choice) {
    return hyperlattice_kernels_baseline(choice);
  }

 private:
  Options options_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<WrongForce>(); }
