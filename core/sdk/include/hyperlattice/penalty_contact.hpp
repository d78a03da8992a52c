// Penalty contact of bodies with floors and with each other: a force pushes out a particle at a
// depth p inside, with friction.
//
//   N = max(0, c p - b v_n)                        outwards, b = 2 damping sqrt(c m)
//   T = min(mu N, h |v_t|) against v_t             h = grip sqrt(c m)
//
// Below the limit mu N friction is viscous: a particle at rest creeps with the tiny speed mu N / h,
// and time steps stay stable.
#pragma once

#include <hyperlattice/files.hpp>
#include <hyperlattice/load.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace hyperlattice {

/// Returns c of a whole particle, N/m: `asked`, or the stiffness of the region's stiffest base
/// spring. Throws std::invalid_argument if there is none. Warns if the contact is far softer than
/// the body.
inline double contact_stiffness(const LoadBody& body, RegionId region, std::optional<double> asked,
                                const LoadSink& sink) {
  double stiffest = 0;
  for (const RestSpring& spring : body.springs(region))
    stiffest = std::max(stiffest, spring.stiffness / spring.share);
  const double stiffness = asked.value_or(stiffest);
  if (!(stiffness > 0))
    throw std::invalid_argument("stiffness as a number: the region has no springs to take it from");
  constexpr double soft = 1e-4;
  if (stiffness < soft * stiffest)
    sink.warn("its stiffness of " + short_number(stiffness, 3) + " N/m is " +
              short_number(stiffness / stiffest, 2) +
              " of the body's stiffest spring: particles may pass through each other or through "
              "the floor");
  return stiffness;
}

/// Forces of one contact: a spring and a damper along the normal, and friction across it.
struct PenaltyContact {
  double stiffness = 0;  ///< c, N/m
  double damping = 0;    ///< b, N s/m
  double grip = 0;       ///< h, N s/m

  /// `mass`, kg; damping and grip as fractions of 2 sqrt(c m) and sqrt(c m).
  PenaltyContact(double c, double mass, double damping_share, double grip_share) : stiffness(c) {
    const double measure = std::sqrt(c * mass);
    damping = 2 * damping_share * measure;
    grip = grip_share * measure;
  }

  /// Returns the force, N, at a depth above 0, m. `away`: outward unit vector; `v`: velocity
  /// relative to the other body, m/s; friction(v_t): the coefficient mu.
  template <class Friction>
  Vec3 force(double depth, Vec3 away, Vec3 v, const Friction& friction) const {
    const double outwards = dot(v, away), N = std::max(0.0, stiffness * depth - damping * outwards);
    const Vec3 along = v - outwards * away;
    const double speed = norm(along);
    if (speed == 0) return N * away;
    return N * away - (std::min(friction(along) * N, grip * speed) / speed) * along;
  }
};

}  // namespace hyperlattice
