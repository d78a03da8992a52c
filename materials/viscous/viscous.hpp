// The Kelvin-Voigt law: an elastic spring with a damper in parallel,
//   f = k (u + tau du/dt),
// with the elongation u. The stored energy is k u^2 / 2.
#pragma once

#include <hyperlattice/law.hpp>

struct ViscousLaw {
  struct Constants {
    double time;  ///< viscosity over stiffness, tau, s
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
