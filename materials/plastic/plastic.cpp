// An elastic-plastic solid. Under a stress s along [100] an elastic lattice's springs carry forces in a fixed proportion; each may carry, at most,
// what it carries at s = yield:
//   limit = |k L strain|,  strain of a spring along n: (n_x^2 - nu (n_y^2 + n_z^2)) yield / E.
// So all springs that a bar along [100] pulls yield at once, when its stress is the stated one, and the bar's curve has one sharp knee; springs
// across the bar get the same limit as those along it. After it, hardening h = ratio k / (1 - ratio) leaves each spring the tangent ratio k.
#include "plastic.hpp"

#include <hyperlattice/elastic_solid.hpp>
#include <hyperlattice/kernels/choose.hpp>

namespace {
using namespace hyperlattice;

class Plastic {
 public:
  struct Options : elastic_solid::Options {
    double yield = 0, hardening = 0;
  };

  static constexpr std::string_view law = "plastic";

  static Schema<Options> schema() {
    Schema<Options> schema("materials.plastic", "Elastic-plastic springs with linear hardening; a bar along [100] yields at the stated stress");
    schema.equation("f = k (u - w), |f| <= limit + h p; limit = k L (1 - (1 + nu) (n_y^2 + n_z^2)) yield / young along the bar")
        .source("return mapping of one-dimensional plasticity (Simo and Hughes 1998, section 1.2), for each spring")
        .restrictions("structured lattices, membrane none")
        .add<&Options::yield>("yield", "Pa", "stress along [100] at which a bar leaves the elastic line")
        .example("\"10 MPa\"")
        .positive()
        .add<&Options::hardening>("hardening", "", "tangent stiffness of a spring that yields, over its elastic one")
        .at_least(0)
        .below(1)
        .fallback("0");
    return Options::declare(schema);
  }

  explicit Plastic(const Options& options) : options_(options) {}

  MaterialConstants constants(const LatticeFacts& lattice) const {
    if (lattice.neighbours.empty())
      throw std::invalid_argument("a structured lattice: springs that point in all directions do not yield at one stress");
    MaterialConstants constants = options_.constants(lattice);
    if (constants.has_cross_springs()) throw std::invalid_argument("membrane none: how cross springs yield is not known");
    const double poisson = lattice.elastic_constants(constants).poisson(), strain = options_.yield / options_.young;
    for (std::uint32_t c = 0; c < lattice.spring_classes; ++c) {
      double along = 0, length = 0;  // of the class's springs that are pulled most
      for (const Neighbour& n : lattice.neighbours) {
        if (n.spring_class != c) continue;
        const Vec3 rest = lattice.spacing * combined(lattice.basis, n.dx, n.dy, n.dz);
        length = norm(rest);
        const double of_x = rest.x * rest.x / dot(rest, rest);
        along = std::max(along, of_x - poisson * (1 - of_x));
      }
      const double stiffness = constants.base_stiffness * lattice.class_stiffness[c];
      constants.set_law(c, 0, PlasticLaw::Constants{stiffness * length * along * strain, stiffness * options_.hardening / (1 - options_.hardening)});
    }
    return constants;
  }
  static KernelSet kernels(const KernelChoice& choice) { return kernels_for_processor(choice); }

 private:
  Options options_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Plastic>(); }
