// The standard linear solid: an elastic spring in parallel with a spring and damper in series
// (Maxwell element), whose force relaxes in the time tau,
//   f = k ((1 - g) u + g (u - w)),  dw/dt = (u - w) / tau,
// with the elongation u and the elongation w of the damper.
#pragma once

#include <hyperlattice/law.hpp>

#include <cmath>

struct RelaxingLaw {
  struct Constants {
    double share;  ///< g: fraction of the instantaneous stiffness that relaxes
    double time;   ///< relaxation time tau, s
  };
  struct Memory {
    double flowed;  ///< w: elongation of the damper, m
  };

  /// Integrates dw/dt over one time step, exactly if the elongation changes at a constant rate.
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
