// An elastic-plastic spring with linear isotropic hardening: its force stays within +-(limit + h
// p), p the plastic elongation summed so far; what is more flows away,
//   f = k (u - w),  |f| <= limit + h p,  dp = |dw|.
#pragma once

#include <hyperlattice/law.hpp>

#include <cmath>

struct PlasticLaw {
  struct Constants {
    double limit;      ///< N
    double hardening;  ///< h, N/m
  };
  struct Memory {
    double flowed;  ///< w, m
    double summed;  ///< p, m
  };

  static void update(const hyperlattice::SpringState& s, const Constants& c, Memory& m) {
    const double force = s.stiffness * (s.elongation - m.flowed),
                 excess = std::abs(force) - (c.limit + c.hardening * m.summed);
    if (excess <= 0) return;
    const double flow = excess / (std::abs(s.stiffness) + c.hardening);
    m.summed += flow;
    m.flowed += std::copysign(flow, s.elongation - m.flowed);
  }
  static double force(const hyperlattice::SpringState& s, const Constants&, const Memory& m) {
    return s.stiffness * (s.elongation - m.flowed);
  }
  static double energy(const hyperlattice::SpringState& s, const Constants&, const Memory& m) {
    const double elastic = s.elongation - m.flowed;
    return 0.5 * s.stiffness * elastic * elastic;
  }
};
