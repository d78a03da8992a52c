// A spring that softens once it is stretched beyond its strength: damage D takes its stiffness
// away, along a straight line to nothing,
//   f = (1 - D) k u,  D = u2 (w - u1) / (w (u2 - u1)) for the largest elongation w so far between
//   u1 and u2, 1 beyond.
// Under compression a crack closes: the spring is whole.
#pragma once

#include <hyperlattice/law.hpp>

#include <algorithm>

struct SofteningLaw {
  struct Constants {
    double strength;  ///< u1 over the length at rest: strain at the largest force
    double opening;   ///< u2 likewise: strain at which nothing is left
  };
  struct Memory {
    double largest;  ///< elongation so far, m
  };

  static double left(const hyperlattice::SpringState& s, const Constants& c,
                     const Memory& m) {  // 1 - D
    const double largest = m.largest / s.rest_length;
    if (s.elongation < 0 || largest <= c.strength) return 1;
    if (largest >= c.opening) return 0;
    return c.strength * (c.opening - largest) / (largest * (c.opening - c.strength));
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
