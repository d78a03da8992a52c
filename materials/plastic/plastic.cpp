// An elastic-plastic solid. Under a stress along [100], the forces of the springs of an elastic
// lattice have fixed ratios. The limit of a spring is its force at the stress `yield`:
//   limit = |k u|
//   u = R.e.R / L                                     base spring
//   u = (R.e.R + 2 h Delta) / sqrt(L^2 + Delta^2)     cross spring
// with the rest vector R, the strain e = (1, -nu, -nu) yield / E, and the equilibrium height h of a
// free membrane (0 if clamped), which the forces of the cross springs set.
//
// So all springs along a bar in [100] yield at once at the stress `yield`, and the stress-strain
// curve has one sharp knee. Springs across the bar have the limit of those along it and must carry
// less; some membranes do not fulfil this and are refused. Then `yield` is also the largest stress
// of a bar without hardening: the bar can flow at constant width and heights, and this flow needs
// the work of this stress. Hardening h = ratio k / (1 - ratio) gives each spring the tangent
// ratio k.
#include "plastic.hpp"

#include <hyperlattice/elastic_solid.hpp>
#include <hyperlattice/kernels/choose.hpp>

namespace {
using namespace hyperlattice;

/// The elongations of the springs of an infinite elastic lattice under tension along [100]; a free
/// membrane is at its equilibrium height.
class Pulled {
 public:
  Pulled(const LatticeFacts& lattice, const MaterialConstants& constants, double strain)
      : lattice_(lattice),
        strain_(strain),
        poisson_(lattice.elastic_constants(constants).poisson()) {
    const double delta = lattice.membrane_distance;
    double push = 0,
           stiffness = constants.alpha_ratio;  // of a particle's height, over 2 k
    for (const Neighbour& n : lattice.neighbours) {
      const double ratio = constants.cross_ratio[n.spring_class] / (square(n) + delta * delta);
      push += ratio * growth(n) * delta;
      stiffness += 2 * ratio * delta * delta;
    }
    if (!constants.clamped && constants.has_cross_springs()) height_ = -push / stiffness;
  }

  /// Returns the largest absolute elongation, m, of the springs of a class that have a component
  /// along the bar; `cross`: 1 for cross springs, 0 for base springs.
  double limit(std::uint32_t spring_class, int cross) const {
    return largest(spring_class, cross, true);
  }
  /// Returns the same for the springs normal to the bar.
  double across(std::uint32_t spring_class, int cross) const {
    return largest(spring_class, cross, false);
  }

 private:
  Vec3 rest(const Neighbour& n) const {
    return lattice_.spacing * combined(lattice_.basis, n.dx, n.dy, n.dz);
  }
  double square(const Neighbour& n) const { return dot(rest(n), rest(n)); }
  /// Returns R.e.R, m2: half the change of the squared length.
  double growth(const Neighbour& n) const {
    const Vec3 r = rest(n);
    return strain_ * (r.x * r.x - poisson_ * (r.y * r.y + r.z * r.z));
  }
  double elongation(const Neighbour& n, int cross) const {
    const double delta = lattice_.membrane_distance;
    if (cross == 0) return growth(n) / std::sqrt(square(n));
    return (growth(n) + 2 * delta * height_) / std::sqrt(square(n) + delta * delta);
  }
  double largest(std::uint32_t spring_class, int cross, bool along) const {
    double found = 0;
    for (const Neighbour& n : lattice_.neighbours)
      if (n.spring_class == spring_class && (rest(n).x != 0) == along)
        found = std::max(found, std::abs(elongation(n, cross)));
    return found;
  }

  const LatticeFacts& lattice_;
  double strain_, poisson_, height_ = 0;
};

class Plastic {
 public:
  struct Options : elastic_solid::Options {
    double yield = 0, hardening = 0;
  };

  static constexpr std::string_view law = "plastic";

  static Schema<Options> schema() {
    Schema<Options> schema("materials.plastic",
                           "Elastic-plastic springs with linear hardening; a bar along [100] "
                           "yields at the stated stress");
    schema
        .equation(
            "f = k (u - w), |f| <= limit + h p; limit: what each spring carries in an elastic bar "
            "along [100] under the stress yield")
        .source(
            "return mapping of one-dimensional plasticity (Simo and Hughes 1998, section 1.2), for "
            "each spring")
        .restrictions(
            "structured lattices; springs of positive stiffness, of which those across a bar carry "
            "less than those along it: without a membrane, poisson up to 1/3")
        .field("plastic_strain", "",
               "mean over the particle's springs of plastic elongation over length at rest")
        .field("equivalent_plastic_strain", "",
               "the same of the accumulated amount of plastic elongation")
        .add<&Options::yield>("yield", "Pa",
                              "stress along [100] at which a bar leaves the elastic line")
        .example("\"10 MPa\"")
        .positive()
        .add<&Options::hardening>("hardening", "",
                                  "tangent stiffness of a spring that yields, over its elastic one")
        .at_least(0)
        .below(1)
        .fallback("0");
    return Options::declare(schema);
  }

  explicit Plastic(const Options& options) : options_(options) {}

  MaterialConstants constants(const LatticeFacts& lattice) const {
    if (lattice.neighbours.empty())
      throw std::invalid_argument(
          "a structured lattice: springs that point in all directions do not yield at one stress");
    MaterialConstants constants = options_.constants(lattice);
    const Pulled bar(lattice, constants, options_.yield / options_.young);
    for (std::uint32_t c = 0; c < lattice.spring_classes; ++c)
      for (const int cross : {0, 1}) {
        const double stiffness = constants.base_stiffness * (cross == 0 ? lattice.class_stiffness[c]
                                                                        : constants.cross_ratio[c]);
        if (stiffness < 0)
          throw std::invalid_argument(
              "membrane of another kind, or a smaller poisson: springs of negative stiffness would "
              "give energy when they yield");
        if (stiffness == 0) continue;
        const double limit = bar.limit(c, cross), across = bar.across(c, cross);
        if (across > limit)
          throw std::invalid_argument(elastic_solid::text(
              // No membrane reaches more than 1/3.
              options_.membrane == elastic_solid::Membrane::none
                  ? "poisson at most 1/3"
                  : "membrane of another kind, or a smaller poisson",
              ": springs across a bar would yield at ", limit / across,
              " of the stress at which those along it do"));
        constants.set_law(c, cross,
                          PlasticLaw::Constants{stiffness * limit, stiffness * options_.hardening /
                                                                       (1 - options_.hardening)});
      }
    return constants;
  }
  static KernelSet kernels(const KernelChoice& choice) { return kernels_for_processor(choice); }

 private:
  Options options_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Plastic>(); }
