// The law of springs whose force is an expression of the elongation and its rate. Its functions are
// those of the expressions that the material has registered (spring_force.hpp).
#pragma once

#include "elastic_expression.hpp"

struct ExpressionLaw {
  using Constants = ElasticExpressionLaw::Constants;
  struct Memory {
    /// The stored energy, J, at the elongation `at`, m: the integral of the force without its rate.
    double energy, at;
    double force;  ///< at the last update, N
  };

  static void update(const hyperlattice::SpringState& s, const Constants& c, Memory& m);
  static double force(const hyperlattice::SpringState& s, const Constants& c, const Memory& m);
  static double energy(const hyperlattice::SpringState& s, const Constants& c, const Memory& m);
  static double tangent(const hyperlattice::SpringState& s, const Constants& c, const Memory& m);
};
