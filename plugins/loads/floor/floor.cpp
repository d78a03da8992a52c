// A floor: a half-space that supports the body, with Coulomb friction. A particle whose rim (in a
// body of partial cells, for a particle outside the shape, the surface above it) is at the depth d
// > 0 below the surface has the penalty forces
//   N = max(0, c d - b v_n)  outwards,        b = damping 2 sqrt(c m)
//   T = min(mu N, h |v_t|)   against v_t,     h = grip sqrt(c m)
// with the velocities v_n out of the floor and v_t along it. Below the limit mu N, friction is
// viscous: time steps stay stable, and a particle at rest creeps slowly, at mu N / h or less. The
// coefficient mu is mu_f (`friction`) along `forward` and mu_b (`friction_back`) against it; for
// other directions
//   mu = (mu_f + mu_b) / 2 + (mu_f - mu_b) / 2 (v_t . forward) / |v_t|
#include <hyperlattice/files.hpp>
#include <hyperlattice/penalty_contact.hpp>

#include <vector>

namespace {
using namespace hyperlattice;

class Floor {
 public:
  struct Options {
    RegionId on;
    Vec3 point, normal, forward;
    std::optional<double> stiffness, friction_back;
    double friction = 0, damping = 0, grip = 0;
  };

  static Schema<Options> schema() {
    return Schema<Options>("loads.floor",
                           "A half-space that holds the body up, with friction that may differ "
                           "forwards and backwards")
        .equation(
            "N = max(0, c d - b v_n), T = min(mu N, h |v_t|) against v_t; b = 2 damping sqrt(c m), "
            "h = grip sqrt(c m)")
        .source(
            "penalty contact with Coulomb friction, regularised by a viscosity; c, b and h enter "
            "the critical step")
        .restrictions(
            "a particle at rest on the floor creeps with mu N / h; particles that are deeper than "
            "half a spacing mean a floor too soft")
        .add<&Options::on>("on", "", "the particles that may touch the floor")
        .fallback("\"outer_surface\"")
        .add<&Options::point>("point", "m", "on the floor")
        .fallback("[0, 0, 0]")
        .add<&Options::normal>("normal", "", "out of the floor; any length")
        .fallback("[0, 0, 1]")
        .add<&Options::stiffness>("stiffness", "N/m",
                                  "c, of the contact of a whole particle; auto: that of the "
                                  "stiffest base spring of the region")
        .word("auto")
        .fallback("\"auto\"")
        .positive()
        .add<&Options::damping>(
            "damping", "",
            "of the normal motion, over the critical one of a particle alone on its contact")
        .at_least(0)
        .at_most(1)
        .fallback("0.2")
        .add<&Options::friction>("friction", "", "coefficient mu")
        .at_least(0)
        .fallback("0")
        .add<&Options::friction_back>("friction_back", "",
                                      "the coefficient against `forward`; left out: the same")
        .at_least(0)
        .add<&Options::forward>(
            "forward", "",
            "direction of the smaller or larger friction; its part along the floor counts")
        .fallback("[0, 0, 0]")
        .add<&Options::grip>("grip", "", "viscosity of friction below its limit, over sqrt(c m)")
        .positive()
        .fallback("1")
        .check([](const Options& o, const FaultSink& faults) {
          if (o.normal == Vec3{}) faults.fault("normal", "a direction");
          if (o.normal != Vec3{} && o.friction_back && along_floor(o) == Vec3{})
            faults.fault("forward", "a direction along the floor, for friction_back");
        });
  }

  explicit Floor(const Options& o)
      : o_(o), normal_(direction_of(o.normal)), forward_(along_floor(o)) {}

  void declare(const LoadBody& body, const LoadSink& sink) {
    const double whole = contact_stiffness(body, o_.on, o_.stiffness, sink);
    const bool rubs = o_.friction > 0 || o_.friction_back.value_or(0) > 0;
    double deepest = 0;
    for (const Particle particle : body.particles(o_.on)) {
      const double gap = body.gap(particle, normal_);
      if (gap == infinity) continue;
      const PenaltyContact law(whole * body.share(particle), body.mass(particle), o_.damping,
                               o_.grip);
      sink.watch(particle, {law.stiffness, std::max(law.damping, rubs ? law.grip : 0)});
      contacts_.push_back({dot(body.position(particle) - o_.point, normal_) + gap - body.rim, law});
      deepest = std::max(deepest, -contacts_.back().height);
    }
    constexpr double noticeable = 0.1;  // spacings
    if (deepest > noticeable * body.spacing)
      sink.warn(
          "the body begins up to " + short_number(deepest / body.spacing, 3) +
          " spacings deep in the floor, which throws it out: expected a floor that it touches");
  }
  double factor(double) const { return 1; }

  Vec3 answer(const WatchedMotion& motion, std::size_t n) const {
    const Contact& contact = contacts_[n];
    const double depth = -contact.height - dot(motion.displacement[n], normal_);
    if (!(depth > 0)) return {};
    return contact.law.force(depth, normal_, motion.velocity[n], [this](Vec3 along) {
      const double back = o_.friction_back.value_or(o_.friction);
      return 0.5 * (o_.friction + back) +
             0.5 * (o_.friction - back) * dot(along, forward_) / norm(along);
    });
  }

 private:
  /// Returns the direction of the part of `forward` along the floor; zero if it has none.
  static Vec3 along_floor(const Options& o) {
    const Vec3 forward = scaled(o.forward), normal = direction_of(o.normal),
               along = forward - dot(forward, normal) * normal;
    constexpr double rounding = 1e-14;
    return norm(along) > rounding ? direction_of(along) : Vec3{};
  }

  struct Contact {
    double height;  ///< height of the particle's rim over the floor, in the undeformed body, m
    PenaltyContact law;
  };
  Options o_;
  Vec3 normal_, forward_;
  std::vector<Contact> contacts_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Floor>(); }
