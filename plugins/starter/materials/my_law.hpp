// The law: what one spring does. This one wears out: its stiffness falls with the way p that its
// elongation has gone so far, back and forth,
//   f = k exp(-p / wear) u.
#pragma once

#include <hyperlattice/law.hpp>

#include <cmath>

struct MyLaw {
  struct Constants {
    double wear;  ///< m
  };
  struct Memory {
    double gone;  ///< p, m; zero at first
  };

  /// Once a step, before the force is asked for.
  static void update(const hyperlattice::SpringState& s, const Constants&, Memory& m) {
    m.gone += std::abs(s.rate) * s.time_step;
  }
  /// N, positive if the spring pulls.
  static double force(const hyperlattice::SpringState& s, const Constants& c, const Memory& m) {
    return std::exp(-m.gone / c.wear) * s.stiffness * s.elongation;
  }
  /// J, what the spring would give back. What it dissipates follows: the work of its force less the
  /// change of this.
  static double energy(const hyperlattice::SpringState& s, const Constants& c, const Memory& m) {
    return 0.5 * std::exp(-m.gone / c.wear) * s.stiffness * s.elongation * s.elongation;
  }
};
