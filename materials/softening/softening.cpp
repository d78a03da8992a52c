// A quasi-brittle solid: springs soften along a straight line, so that what a crack costs does not depend on the spacing (the crack band). A spring
// carries its largest force at the strain e = strength / E, where a bar along [100] leaves the elastic line, and nothing at r e. Both follow the
// spring's length L, so all springs of a site that a plane normal to [100] cuts take
//   1/2 r e^2 sum k L^2 = G_c A,  A the plane's area for each site,
// cross springs counted beside their base springs: r = 2 G_c A / (e^2 sum k L^2). Below r = 1 a spring would break before it softens: the spacing is
// too coarse for this G_c.
#include "softening.hpp"

#include <hyperlattice/elastic_solid.hpp>
#include <hyperlattice/kernels/choose.hpp>

namespace {
using namespace hyperlattice;

class Softening {
 public:
  struct Options : elastic_solid::Options {
    double strength = 0, fracture_energy = 0;
  };

  static constexpr std::string_view law = "softening";

  static Schema<Options> schema() {
    Schema<Options> schema("materials.softening",
                           "Springs that soften when stretched beyond a strength, with a fracture energy that the spacing does not change");
    schema
        .equation(
            "f = (1 - D) k u; the largest force at the strain strength / young, none at r times that; r = 2 G_c A / (e^2 sum k L^2) over the springs "
            "through a plane normal to [100]")
        .source("Bazant and Oh 1983 (crack band), applied to the lattice's springs; closed cracks carry compression")
        .restrictions("structured lattices, precision double; the spacing must be small enough for the fracture energy")
        .add<&Options::strength>("strength", "Pa", "tensile stress of a bar along [100] at which springs begin to soften")
        .example("\"3 MPa\"")
        .positive()
        .add<&Options::fracture_energy>("fracture_energy", "J/m2", "energy that a crack normal to [100] takes for each of its area")
        .example("\"5 J/m2\"")
        .positive();
    return Options::declare(schema);
  }

  explicit Softening(const Options& options) : options_(options) {}

  MaterialConstants constants(const LatticeFacts& lattice) const {
    MaterialConstants constants = options_.constants(lattice);
    const double strain = options_.strength / options_.young;
    double through = 0, area = lattice.site_volume / lattice.spacing;  // sum k L^2 of the springs of a site's part of the plane
    for (const Neighbour& n : lattice.neighbours) {
      const Vec3 rest = lattice.spacing * combined(lattice.basis, n.dx, n.dy, n.dz);
      const double square = dot(rest, rest), delta = lattice.membrane_distance, crossings = std::abs(rest.x) / lattice.spacing;
      const double cross = constants.cross_ratio[n.spring_class] * (square + delta * delta);
      through += crossings * constants.base_stiffness * (lattice.class_stiffness[n.spring_class] * square + cross);
    }
    const double ratio = 2 * options_.fracture_energy * area / (strain * strain * through);
    if (!(ratio > 1)) {
      const double spacing = lattice.spacing * ratio;
      throw std::invalid_argument(elastic_solid::text("fracture_energy of more than ", options_.fracture_energy / ratio, " J/m2, or a spacing below ",
                                                      spacing, " m: springs of this length break before they soften"));
    }
    for (const Neighbour& n : lattice.neighbours) {
      const double length = norm(lattice.spacing * combined(lattice.basis, n.dx, n.dy, n.dz)),
                   cross_length = std::hypot(length, lattice.membrane_distance);
      constants.set_law(n.spring_class, 0, SofteningLaw::Constants{strain * length, ratio * strain * length});
      constants.set_law(n.spring_class, 1, SofteningLaw::Constants{strain * cross_length, ratio * strain * cross_length});
    }
    return constants;
  }
  static KernelSet kernels(const KernelChoice& choice) { return kernels_for_processor(choice); }

 private:
  Options options_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Softening>(); }
