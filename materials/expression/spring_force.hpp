// Force, energy and tangent of a spring from expressions, and the list of the expressions of this
// process, in which kernels find them by a number.
#pragma once

#include <quantities/compiled.hpp>
#include <quantities/expression.hpp>

#include <hyperlattice/law.hpp>

#include <array>
#include <optional>

namespace hyperlattice::spring_expression {

/// The inputs of both expressions, in their order.
enum Input : std::size_t {
  elongation,
  strain,
  rate,
  strain_rate,
  stiffness,
  rest_length,
  input_count
};

/// Returns the inputs of a spring, or of a vector of springs. `inverse`: of the rest length. The
/// product with it is faster than a division.
template <class Real>
std::array<Real, input_count> inputs_of(const Real& stiffness, const Real& length,
                                        const Real& inverse, const Real& elongated,
                                        const Real& rate_of_it) {
  return {elongated, elongated * inverse, rate_of_it, rate_of_it * inverse, stiffness, length};
}

/// Gauss's rule of three points: places from the middle of the interval, in half lengths, and
/// weights, whose sum is 1.
struct GaussRule {
  static constexpr double outer = 0.774596669241483377;
  static constexpr double weight_outer = 5.0 / 18, weight_middle = 4.0 / 9;
  static constexpr int exact_degree = 5;  ///< of polynomials
};

/// Returns the names of these inputs with their dimensions.
std::vector<ExpressionName> input_names();

/// The expressions of a material.
struct SpringForce {
  SpringForce(Compiled force_expression, std::optional<Compiled> energy_expression);

  Compiled force;                  ///< N
  std::optional<Compiled> energy;  ///< J; without it, the energy is the integral of the force
  bool has_strain;                 ///< the force depends on the strain or its rate
  /// The energy is the integral of the force, and GaussRule has no error over any way.
  bool has_exact_rule;

  double force_at(const SpringState& spring) const;
  /// Returns the derivative of the force by the elongation, at a constant rate, N/m.
  double tangent_at(const SpringState& spring) const;
  /// Returns the derivative of the force by the rate, N s/m.
  double viscosity_at(const SpringState& spring) const;
  /// Returns the energy, J, at the spring's elongation less that at the elongation `from`.
  double energy_since(const SpringState& spring, double from) const {
    return advance(spring, from).energy;
  }

  struct Advance {
    double energy = 0;  ///< J, at the spring's elongation less that at the elongation before
    double force = 0;   ///< N, at the spring's elongation and rate
  };
  /// Returns both; if the spring has moved by a short way, in one evaluation of the expression.
  Advance advance(const SpringState& spring, double from) const;

  /// Returns whether the force depends on the rate of the elongation.
  bool has_rate() const { return force.uses(rate) || force.uses(strain_rate); }

 private:
  Advance advance_by_rule(const SpringState& spring, double from) const;
  double integral(const SpringState& spring, double from) const;
};

/// Keeps the expressions until the process ends, and returns their number. `text` names them: equal
/// texts get one number. Throws std::runtime_error after 10,000 different ones.
std::size_t keep(const std::string& text, const SpringForce& force);

/// Returns the expressions of a number. Any thread may ask.
const SpringForce& kept(double number);

}  // namespace hyperlattice::spring_expression
