// Kelvin and Voigt's spring: a damper beside each elastic spring, f = k (u + tau du/dt).
#pragma once

#include <hyperlattice/law.hpp>

struct ViscousLaw {
  struct Constants {
    double time;  ///< tau, s
  };
  struct Memory {};

  static void update(const hyperlattice::SpringState&, const Constants&, Memory&) {}
  static double force(const hyperlattice::SpringState& s, const Constants& c, const Memory&) {
    return s.stiffness * (s.elongation + c.time * s.rate);
  }
  static double energy(const hyperlattice::SpringState& s, const Constants&, const Memory&) {
    return 0.5 * s.stiffness * s.elongation * s.elongation;
  }
};
