// A law that is 1.5 times as stiff as its constants say. Its force is the derivative of its energy,
// so that the energy balance closes in steps that are too long for it. Its kernels are for one
// instruction set only, to save time of compilation.
#define HYPERLATTICE_INSTRUCTIONS baseline
#include <hyperlattice/elastic_solid.hpp>
#include <hyperlattice/kernels/law_kernels.hpp>

struct StifferLaw {
  static constexpr double factor = 1.5;

  template <class Real>
  static Real force(Real stiffness, Real elongation) {
    return factor * stiffness * elongation;
  }
  template <class Real>
  static Real energy(Real stiffness, Real elongation) {
    return factor * stiffness * elongation * elongation / 2;
  }
  template <class Real>
  static Real tangent(Real stiffness, Real /*elongation*/) {
    return factor * stiffness;
  }
};
HYPERLATTICE_KERNELS(StifferLaw)

namespace {
using namespace hyperlattice;

class Stiffer {
 public:
  struct Options : elastic_solid::Options {};
  static constexpr std::string_view law = "stiffer";

  static Schema<Options> schema() {
    Schema<Options> schema("materials.stiffer", "Springs stiffer than their constants say");
    return Options::declare(schema);
  }
  explicit Stiffer(const Options& options) : options_(options) {}
  MaterialConstants constants(const LatticeFacts& lattice) const {
    return options_.constants(lattice);
  }
  static KernelSet kernels(const KernelChoice& choice) {
    return hyperlattice_kernels_baseline(choice);
  }

 private:
  Options options_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Stiffer>(); }
