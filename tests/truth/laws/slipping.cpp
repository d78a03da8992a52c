// A law with a memory and a field of its own: a spring with a slider,
//   f = k (u - w), |f| <= k s L,
// with the elongation u, the slip w, the rest length L and the strain s at which it slips. Its
// kernels are for one instruction set, to be compiled soon.
#define HYPERLATTICE_INSTRUCTIONS baseline
#include <hyperlattice/elastic_solid.hpp>
#include <hyperlattice/kernels/law_kernels.hpp>

struct SlippingLaw {
  struct Constants {
    double strain;  ///< s
  };
  struct Memory {
    double slip;  ///< w, m
  };
  struct Fields {
    double slip, plastic_strain;
  };

  static void update(const hyperlattice::SpringState& s, const Constants& c, Memory& m) {
    const double most = c.strain * s.rest_length, held = s.elongation - m.slip;
    if (held > most) m.slip = s.elongation - most;
    if (held < -most) m.slip = s.elongation + most;
  }
  static double force(const hyperlattice::SpringState& s, const Constants&, const Memory& m) {
    return s.stiffness * (s.elongation - m.slip);
  }
  static double energy(const hyperlattice::SpringState& s, const Constants&, const Memory& m) {
    return 0.5 * s.stiffness * (s.elongation - m.slip) * (s.elongation - m.slip);
  }
  static Fields fields(const hyperlattice::SpringState& s, const Constants&, const Memory& m) {
    return {m.slip, m.slip / s.rest_length};
  }
};
HYPERLATTICE_KERNELS(SlippingLaw)

namespace {
using namespace hyperlattice;

class Slipping {
 public:
  struct Options : elastic_solid::Options {
    double strain = 0;
  };
  static constexpr std::string_view law = "slipping";

  static Schema<Options> schema() {
    Schema<Options> schema("materials.slipping", "Springs that slip");
    schema.equation("f = k (u - w), |f| <= k strain L")
        .field("slip", "m", "mean slip of the particle's springs")
        .field("plastic_strain", "", "another meaning than that of materials.plastic")
        .add<&Options::strain>("strain", "", "strain at which a spring slips")
        .example("0.001")
        .positive();
    return Options::declare(schema);
  }
  explicit Slipping(const Options& options) : options_(options) {}
  MaterialConstants constants(const LatticeFacts& lattice) const {
    MaterialConstants constants = options_.constants(lattice);
    constants.set_law(SlippingLaw::Constants{options_.strain});
    return constants;
  }
  static KernelSet kernels(const KernelChoice& choice) {
    return hyperlattice_kernels_baseline(choice);
  }

 private:
  Options options_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Slipping>(); }
