// A spring that softens linearly beyond its strength. The damage D reduces its stiffness,
//   f = (1 - D) k u,  D = u2 (w - u1) / (w (u2 - u1)) for u1 < w < u2,
// with the largest elongation w so far; D = 0 for w <= u1 and D = 1 for w >= u2. In compression a
// crack is closed: the spring has its full stiffness.
#pragma once

#include <hyperlattice/law.hpp>

#include <algorithm>

struct SofteningLaw {
  struct Constants {
    double strength;  ///< u1 over the rest length: strain at the largest force
    double opening;   ///< u2 over the rest length: strain at which the force is 0
  };
  struct Memory {
    double largest;  ///< largest elongation so far, m
  };

  /// Returns 1 - D.
  static double integrity(const hyperlattice::SpringState& s, const Constants& c, const Memory& m) {
    const double largest = m.largest / s.rest_length;
    if (largest <= c.strength) return 1;
    if (largest >= c.opening) return 0;
    return c.strength * (c.opening - largest) / (largest * (c.opening - c.strength));
  }
  static double left(const hyperlattice::SpringState& s, const Constants& c, const Memory& m) {
    return s.elongation < 0 ? 1 : integrity(s, c, m);
  }
  static void update(const hyperlattice::SpringState& s, const Constants&, Memory& m) {
    m.largest = std::max(m.largest, s.elongation);
  }
  static double force(const hyperlattice::SpringState& s, const Constants& c, const Memory& m) {
    return left(s, c, m) * s.stiffness * s.elongation;
  }
  static double energy(const hyperlattice::SpringState& s, const Constants& c, const Memory& m) {
    return 0.5 * left(s, c, m) * s.stiffness * s.elongation * s.elongation;
  }
};
