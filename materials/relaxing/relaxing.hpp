// The standard linear solid: beside an elastic spring one in series with a damper, whose part of
// the force relaxes in a time tau,
//   f = k ((1 - g) u + g (u - w)),  dw/dt = (u - w) / tau.
#pragma once

#include <hyperlattice/law.hpp>

#include <cmath>

struct RelaxingLaw {
  struct Constants {
    double share;  ///< g: of the stiffness at once that relaxes
    double time;   ///< tau, s
  };
  struct Memory {
    double flowed;  ///< w: elongation of the damper, m
  };

  /// Exact for an elongation that changes at a constant rate.
  static void update(const hyperlattice::SpringState& s, const Constants& c, Memory& m) {
    const double lag = s.elongation - m.flowed - s.rate * s.time_step, x = s.time_step / c.time;
    m.flowed += -std::expm1(-x) * lag + s.rate * (s.time_step + c.time * std::expm1(-x));
  }
  static double force(const hyperlattice::SpringState& s, const Constants& c, const Memory& m) {
    return s.stiffness * (s.elongation - c.share * m.flowed);
  }
  static double energy(const hyperlattice::SpringState& s, const Constants& c, const Memory& m) {
    const double in_series = s.elongation - m.flowed;
    return 0.5 * s.stiffness *
           ((1 - c.share) * s.elongation * s.elongation + c.share * in_series * in_series);
  }
};
