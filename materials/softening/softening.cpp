// A quasi-brittle solid. Springs soften linearly, such that the fracture energy does not depend on
// the spacing (crack band model). A spring has its largest force at the strain e = strength / E,
// where a bar along [100] leaves the elastic line, and no force from the strain r e on. The energy
// of all springs, cross springs included, that pass through a unit of area is
//   1/2 r e^2 sum k L^2 = G_c,  so  r = 2 G_c / (e^2 sum k L^2)
// with the length L of a spring. For r < 1 a spring would break before it softens: the spacing is
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
                           "Springs that soften when stretched beyond a strength, with a fracture "
                           "energy that the spacing does not change");
    schema
        .equation(
            "f = (1 - D) k u; the largest force at the strain strength / young, none at r times "
            "that; r = 2 G_c / (e^2 sum k L^2) over the springs "
            "through a unit of area normal to [100], in a list normal to any direction")
        .source(
            "Bazant and Oh 1983 (crack band), applied to the lattice's springs; closed cracks "
            "carry compression")
        .restrictions("the spacing must be small enough for the fracture energy")
        .add<&Options::strength>(
            "strength", "Pa",
            "tensile stress of a bar along [100] at which springs begin to soften")
        .example("\"3 MPa\"")
        .positive()
        .add<&Options::fracture_energy>(
            "fracture_energy", "J/m2",
            "energy that a crack normal to [100] takes for each of its area")
        .example("\"5 J/m2\"")
        .positive();
    return Options::declare(schema);
  }

  explicit Softening(const Options& options) : options_(options) {}

  MaterialConstants constants(const LatticeFacts& lattice) const {
    MaterialConstants constants = options_.constants(lattice);
    const double strain = options_.strength / options_.young;
    const double ratio =
        2 * options_.fracture_energy / (strain * strain * through(lattice, constants));
    if (!(ratio > 1)) {
      const double spacing = lattice.spacing * ratio;
      throw std::invalid_argument(
          elastic_solid::text("fracture_energy of more than ", options_.fracture_energy / ratio,
                              " J/m2, or a spacing below ", spacing,
                              " m: springs of this length break before they soften"));
    }
    constants.set_law(SofteningLaw::Constants{strain, ratio * strain});
    return constants;
  }
  static KernelSet kernels(const KernelChoice& choice) { return kernels_for_processor(choice); }

 private:
  /// Returns the sum of k L^2, N/m, over the springs that pass through a unit of area of a plane
  /// normal to [100]. In a list the springs have all directions with the mean |n_x| = 1/2, and the
  /// sum holds for any plane.
  static double through(const LatticeFacts& lattice, const MaterialConstants& constants) {
    const double k = constants.base_stiffness, delta = lattice.membrane_distance;
    if (lattice.neighbours.empty()) {
      const double cross =
          constants.cross_ratio[0] * (lattice.cubed_lengths + delta * delta * lattice.lengths);
      return 0.5 * k * (lattice.cubed_lengths + cross) /
             (static_cast<double>(lattice.particles) * lattice.site_volume);
    }
    double sum = 0;
    for (const Neighbour& n : lattice.neighbours) {
      const Vec3 rest = lattice.spacing * combined(lattice.basis, n.dx, n.dy, n.dz);
      const double square = dot(rest, rest),
                   cross = constants.cross_ratio[n.spring_class] * (square + delta * delta);
      sum += std::abs(rest.x) * k * (lattice.class_stiffness[n.spring_class] * square + cross);
    }
    return sum / lattice.site_volume;
  }

  Options options_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Softening>(); }
