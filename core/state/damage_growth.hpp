// The growth of damage at one particle in one step (docs/theory/cohesive.md): a scalar equation for
// the rate, with stresses that are given.
#pragma once

#include <hyperlattice/strength_surface.hpp>

#include <state/tensor.hpp>

namespace hyperlattice {

/// Returns the principal values of a symmetric tensor, in the closed form with a cosine.
PrincipalStress principal_values(const Symmetric& stress);

/// Damage of a particle at the start of a step, and what drives it. Rates are 1/s.
struct DamageStep {
  double damage = 0, rate = 0;  ///< d and d' half a step before
  double shape = 1;             ///< A
  double drive = 0;             ///< q = (equivalent stress / strength)^2
  double spread = 0;            ///< b^2 times the Laplacian of d
  double inertia = 0;           ///< (b / c_d)^2, s2
  double viscosity = 0;         ///< tau, s
  double time_step = 0;         ///< s
};

/// Returns the rate x of damage over the step, 1/s: the root of
///   g(d + dt x) q - (1 - d - dt x) + b^2 lap d - (b / c_d)^2 (x - d') / dt - tau x = 0
/// in [0, (1 - d) / dt], with g(d) = (1 - d) / (A + (1 - A) (1 - d)^2)^2; 0 if the left side is
/// not positive at 0. The left side falls with x if A >= 3/4 and c_d dt <= b.
double damage_rate(const DamageStep& step);
/// Returns how far damage is from rest: g(d) q - (1 - d) + b^2 lap d, above 0 where it grows. At
/// its first growth it is the square of the stress over the strength, less 1.
double damage_lag(const DamageStep& step);

}  // namespace hyperlattice
