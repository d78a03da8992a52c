// An elastic-plastic spring with linear isotropic hardening,
//   f = k (u - w),  |f| <= limit + h p,  dp = |dw|,
// with the elongation u, the plastic elongation w and its accumulated amount p. A force beyond the
// limit becomes plastic elongation (return mapping).
#pragma once

#include <hyperlattice/law.hpp>

#include <cmath>

struct PlasticLaw {
  struct Constants {
    double limit;      ///< yield force of the virgin spring, N
    double hardening;  ///< h, N/m
  };
  struct Memory {
    double flowed;  ///< plastic elongation w, m
    double summed;  ///< accumulated plastic elongation p, m
  };

  struct Fields {
    double plastic_strain;
    double equivalent_plastic_strain;
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
  /// Returns the consistent tangent: k within the limit of the start of the step, k h / (k + h)
  /// beyond it.
  static double tangent(const hyperlattice::SpringState& s, const Constants& c, const Memory& m) {
    const double force = s.stiffness * (s.elongation - m.flowed);
    if (std::abs(force) <= c.limit + c.hardening * m.summed) return s.stiffness;
    return s.stiffness * c.hardening / (std::abs(s.stiffness) + c.hardening);
  }
  static Fields fields(const hyperlattice::SpringState& s, const Constants&, const Memory& m) {
    return {m.flowed / s.rest_length, m.summed / s.rest_length};
  }
  static double energy(const hyperlattice::SpringState& s, const Constants&, const Memory& m) {
    const double elastic = s.elongation - m.flowed;
    return 0.5 * s.stiffness * elastic * elastic;
  }
};
