// The law of a spring whose force is an expression. The functions are those of the expression that
// the material has registered (spring_force.hpp).
#pragma once

#include <hyperlattice/law.hpp>

struct ExpressionLaw {
  struct Constants {
    double number;  ///< of the registered expression
  };
  /// The stored energy, J, at the elongation `at`, m: the integral of the force without its rate.
  struct Memory {
    double energy, at;
  };

  static void update(const hyperlattice::SpringState& s, const Constants& c, Memory& m);
  static double force(const hyperlattice::SpringState& s, const Constants& c, const Memory& m);
  static double energy(const hyperlattice::SpringState& s, const Constants& c, const Memory& m);
  static double tangent(const hyperlattice::SpringState& s, const Constants& c, const Memory& m);
};
