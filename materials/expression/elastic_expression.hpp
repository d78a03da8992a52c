// The law of springs whose force is an expression of the elongation alone. Kernels evaluate it for
// a vector of springs at once, always in doubles.
#pragma once

#include "spring_force.hpp"

#include <quantities/lanes.hpp>

#include <hyperlattice/law.hpp>

#include <cstring>

namespace hyperlattice::spring_expression {

/// The type of the numbers of a number, or of a vector of numbers.
template <class Real>
struct NumberOf {
  using Type = Real;
};
template <template <class> class Pack, class Number>
struct NumberOf<Pack<Number>> {
  using Type = Number;
};

template <class Real>
constexpr bool is_vector_of_doubles =
    std::is_same_v<typename NumberOf<Real>::Type, double> && !std::is_same_v<Real, double>;

/// Returns a number of each spring of a vector. `number`: called with one spring.
template <class Real, class OfSpring>
Real for_each_spring(const SpringOf<Real>& springs, const OfSpring& number) {
  using Number = typename NumberOf<Real>::Type;
  Number stiffness[sizeof(Real) / sizeof(Number)], rest_length[std::size(stiffness)],
      elongation[std::size(stiffness)], result[std::size(stiffness)];
  std::memcpy(stiffness, &springs.stiffness, sizeof(Real));
  std::memcpy(rest_length, &springs.rest_length, sizeof(Real));
  std::memcpy(elongation, &springs.elongation, sizeof(Real));
  for (std::size_t n = 0; n < std::size(stiffness); ++n)
    result[n] =
        static_cast<Number>(number(SpringState{stiffness[n], rest_length[n], elongation[n], 0, 0}));
  Real numbers;
  std::memcpy(&numbers, result, sizeof numbers);
  return numbers;
}

/// Returns the forces of a vector of springs, N, which depend on no rate.
template <template <class> class Pack>
Pack<double> forces_of(const SpringForce& law, const SpringOf<Pack<double>>& springs) {
  using Doubles = Pack<double>;
  const Doubles none(0.0),
      inverse = law.has_strain ? Doubles(1.0) / springs.rest_length : none;  // divisions are slow
  const std::array<Doubles, input_count> inputs =
      inputs_of(springs.stiffness, springs.rest_length, inverse, springs.elongation, none);
  return values_of<Doubles>(law.force, inputs);
}

/// Returns their energies, J, by GaussRule.
template <template <class> class Pack>
Pack<double> energies_of(const SpringForce& law, const SpringOf<Pack<double>>& springs) {
  using Doubles = Pack<double>;
  const auto force_at = [&](double part) {
    return forces_of(law, SpringOf<Doubles>{springs.stiffness, springs.rest_length,
                                            Doubles(part) * springs.elongation});
  };
  constexpr double reach = GaussRule::outer / 2;
  const Doubles outer = force_at(0.5 - reach) + force_at(0.5 + reach);
  return springs.elongation * (Doubles(GaussRule::weight_middle) * force_at(0.5) +
                               Doubles(GaussRule::weight_outer) * outer);
}

/// The same for a vector of floats, as two vectors of doubles.
template <template <class> class Pack>
Pack<float> forces_of(const SpringForce& law, const SpringOf<Pack<float>>& springs) {
  constexpr std::size_t in_half = sizeof(Pack<double>) / sizeof(double);
  const auto half = [&](const Pack<float>& pack, std::size_t first) {
    float narrow[2 * in_half];
    double wide[in_half];
    std::memcpy(narrow, &pack, sizeof pack);
    for (std::size_t n = 0; n < in_half; ++n) wide[n] = double{narrow[first + n]};
    Pack<double> doubles;
    std::memcpy(&doubles, wide, sizeof doubles);
    return doubles;
  };
  float forces[2 * in_half];
  for (const std::size_t first : {std::size_t{0}, in_half}) {
    const SpringOf<Pack<double>> doubles{half(springs.stiffness, first),
                                         half(springs.rest_length, first),
                                         half(springs.elongation, first)};
    double wide[in_half];
    const Pack<double> found = forces_of(law, doubles);
    std::memcpy(wide, &found, sizeof found);
    for (std::size_t n = 0; n < in_half; ++n) forces[first + n] = static_cast<float>(wide[n]);
  }
  Pack<float> floats;
  std::memcpy(&floats, forces, sizeof floats);
  return floats;
}

}  // namespace hyperlattice::spring_expression

struct ElasticExpressionLaw {
  struct Constants {
    double number;  ///< of the registered expressions
  };

  template <class Real>
  static Real force(const hyperlattice::SpringOf<Real>& springs, const Constants& c) {
    using namespace hyperlattice::spring_expression;
    if constexpr (std::is_same_v<Real, typename NumberOf<Real>::Type>)
      return for_each_spring(springs, [&](const auto& s) { return kept(c.number).force_at(s); });
    else
      return forces_of(kept(c.number), springs);
  }
  template <class Real>
  static Real energy(const hyperlattice::SpringOf<Real>& springs, const Constants& c) {
    using namespace hyperlattice::spring_expression;
    if constexpr (is_vector_of_doubles<Real>)
      if (kept(c.number).has_exact_rule) return energies_of(kept(c.number), springs);
    return for_each_spring(springs,
                           [&](const auto& s) { return kept(c.number).energy_since(s, 0); });
  }
  template <class Real>
  static Real tangent(const hyperlattice::SpringOf<Real>& springs, const Constants& c) {
    using namespace hyperlattice::spring_expression;
    return for_each_spring(springs, [&](const auto& s) { return kept(c.number).tangent_at(s); });
  }
};
