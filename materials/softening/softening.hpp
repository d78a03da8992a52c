// A spring that softens once it is stretched beyond its strength: damage D takes its stiffness away, along a straight line to nothing,
//   f = (1 - D) k u,  D = u2 (w - u1) / (w (u2 - u1)) for the largest elongation w so far between u1 and u2, 1 beyond.
// Under compression a crack closes: the spring is whole.
#pragma once

#include <hyperlattice/law.hpp>

#include <algorithm>

struct SofteningLaw {
  struct Constants {
    double strength;  ///< u1: elongation at the largest force, m
    double opening;   ///< u2: elongation at which nothing is left, m
  };
  struct Memory {
    double largest;  ///< elongation so far, m
  };

  static double left(const hyperlattice::SpringState& s, const Constants& c, const Memory& m) {  // 1 - D
    if (s.elongation < 0 || m.largest <= c.strength) return 1;
    if (m.largest >= c.opening) return 0;
    return c.strength * (c.opening - m.largest) / (m.largest * (c.opening - c.strength));
  }
  static void update(const hyperlattice::SpringState& s, const Constants&, Memory& m) { m.largest = std::max(m.largest, s.elongation); }
  static double force(const hyperlattice::SpringState& s, const Constants& c, const Memory& m) { return left(s, c, m) * s.stiffness * s.elongation; }
  static double energy(const hyperlattice::SpringState& s, const Constants& c, const Memory& m) {
    return 0.5 * left(s, c, m) * s.stiffness * s.elongation * s.elongation;
  }
};
