// Contact of particles by a penalty force: fragments that meet, bodies that collide, cracks that
// close. Two particles at a distance d < d_0 have the depth p = d_0 - d and the forces
//   N = max(0, c p - b v_n)  repulsive,       b = 2 damping sqrt(c m)
//   T = min(mu N, h |v_t|)   against v_t,     h = grip sqrt(c m),  m = m_1 m_2 / (m_1 + m_2)
// with the relative velocities v_n and v_t along and across their line. d_0 is `reach` spacings, at
// most 0.9 of the distance in the undeformed body: so intact neighbours, which are compressed less,
// are not in contact, and neighbours with a broken spring can meet again.
#include "pairs.hpp"

#include <hyperlattice/penalty_contact.hpp>

namespace {
using namespace hyperlattice;

class Contact {
 public:
  struct Options {
    RegionId on;
    double reach = 0, damping = 0, friction = 0, grip = 0;
    std::optional<double> stiffness;
  };

  static Schema<Options> schema() {
    return Schema<Options>("loads.contact",
                           "Particles that come too near push each other away, with friction")
        .equation(
            "N = max(0, c p - b v_n), T = min(mu N, h |v_t|) against v_t, p = min(reach l, 0.9 "
            "d_rest) - d; b = 2 damping sqrt(c m), h = grip sqrt(c "
            "m)")
        .source(
            "short-range forces between particles (Silling and Askari 2005) with Coulomb friction, "
            "regularised by a viscosity; c, b and h enter the "
            "critical step")
        .restrictions(
            "Springs that are compressed by more than a tenth are pushed too: not for laws of "
            "large strains. The energy balance counts the work of contacts as "
            "that of a "
            "load: what they store counts as taken from the body, and comes back. Particles that "
            "are deeper than half a spacing mean a contact too "
            "soft. Bodies that are drawn less than an empty cell apart are joined by springs (plan "
            "counts bodies). With one empty cell between them "
            "centres are two spacings apart. Contact begins when centres are `reach` spacings "
            "apart, so contact begins (1 - reach) spacings later "
            "than the drawn faces would touch. In a body of partial cells, particles that stand "
            "outside the shape meet no others.")
        .add<&Options::on>("on", "", "the particles that may meet each other")
        .fallback("\"all\"")
        .add<&Options::reach>("reach", "",
                              "distance below which particles push each other, in spacings")
        .positive()
        .at_most(1)
        .fallback("0.9")
        .add<&Options::stiffness>(
            "stiffness", "N/m",
            "c, of a pair; auto: that of the stiffest base spring of the region")
        .word("auto")
        .fallback("\"auto\"")
        .positive()
        .add<&Options::damping>(
            "damping", "",
            "of the motion along the line between two particles, over the critical one of the pair")
        .at_least(0)
        .at_most(1)
        .fallback("0")
        .add<&Options::friction>("friction", "", "coefficient mu")
        .at_least(0)
        .fallback("0")
        .add<&Options::grip>("grip", "", "viscosity of friction below its limit, over sqrt(c m)")
        .positive()
        .fallback("0.2");
  }

  explicit Contact(const Options& o) : o_(o) {}

  void declare(const LoadBody& body, const LoadSink& sink) {
    stiffness_ = contact_stiffness(body, o_.on, o_.stiffness, sink);
    reach_ = o_.reach * body.spacing;
    std::vector<Vec3> at_rest;
    for (const Particle particle : body.particles(o_.on)) {
      if (body.gap(particle, {}) > 0) continue;
      at_rest.push_back(body.position(particle));
      mass_.push_back(body.mass(particle));
      // At most twelve particles can be that near, evenly around. The stiffness of a pair counts
      // twice if both move, and friction has two directions.
      constexpr double along = 2 * 12.0 / 3, across = 2 * along;
      const PenaltyContact pair(stiffness_, mass_.back() / 2, o_.damping, o_.grip);
      sink.watch(particle, {along * stiffness_,
                            along * pair.damping + (o_.friction > 0 ? across * pair.grip : 0)});
    }
    pairs_ = contact::Pairs(std::move(at_rest), reach_);
  }
  double factor(double) const { return 1; }
  void prepare(const WatchedMotion& motion) { pairs_.find(motion.displacement); }

  Vec3 answer(const WatchedMotion& motion, std::size_t n) const {
    Vec3 sum;
    for (const std::uint32_t other : pairs_.of(n)) {
      const Vec3 apart = pairs_.apart(other, n, motion.displacement);
      const double distance = norm(apart);
      if (!(distance < reach_) || distance == 0) continue;
      constexpr double held = 0.9;  // of the distance at rest
      const double depth = std::min(reach_, held * pairs_.apart_at_rest(other, n)) - distance;
      if (!(depth > 0)) continue;
      const PenaltyContact pair(stiffness_, mass_[n] * mass_[other] / (mass_[n] + mass_[other]),
                                o_.damping, o_.grip);
      sum += pair.force(depth, (1 / distance) * apart, motion.velocity[n] - motion.velocity[other],
                        [this](Vec3) { return o_.friction; });
    }
    return sum;
  }

 private:
  Options o_;
  double stiffness_ = 0, reach_ = 0;  ///< N/m, m
  std::vector<double> mass_;
  contact::Pairs pairs_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Contact>(); }
