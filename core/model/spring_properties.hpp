// The properties of one spring of the body.
#pragma once

#include <model/composite_spring.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace hyperlattice {

/// The properties of one base spring and of its cross springs.
struct SpringProperties {
  Vec3 rest;                     ///< rest vector from the first end to the second, m
  double rest_length = 0;        ///< metres
  double cross_rest_length = 0;  ///< metres
  double share = 1;              ///< share of the whole spring, 0 to 1
  std::uint32_t spring_class = 0;
  double stiffness = 0, cross_stiffness = 0;  ///< of the whole spring, N/m
  /// The law by its index in SpringTable::laws, and its constants of base and cross springs.
  std::uint32_t law = 0;
  const double* constants[2] = {};
  /// The parts of a spring of several laws or constants, which `law` and `constants` do not
  /// describe; null: a spring of one law.
  const CompositeSpring* composite = nullptr;
  double factor = 1;  ///< stiffness of a listed spring over that of its class

  double rest_length_of(std::size_t cross) const {
    return cross == 0 ? rest_length : cross_rest_length;
  }
  /// Returns the growth of the squared length, m2, of the base (cross 0) or cross spring (1): see
  /// kernels/springs.hpp. `apart`: displacement of the second end less that of the first, m;
  /// `rise`: difference of their heights for a base spring, their sum for a cross spring, m.
  double growth(std::size_t cross, const Vec3& apart, double rise, double membrane_distance) const {
    return dot(apart, 2 * rest + apart) + rise * (cross == 0 ? rise : 2 * membrane_distance + rise);
  }
  /// Returns the present length, m, for a growth of the squared length, m2. Where the ends meet, a
  /// part of the rest length remains (kernels/response.hpp).
  double length(std::size_t cross, double growth) const {
    return present_length(rest_length_of(cross), growth);
  }
  static double present_length(double rest_length, double growth) {
    constexpr double least = 1e-24;
    const double square = rest_length * rest_length;
    return std::sqrt(std::max(square + growth, least * square));
  }
  /// Returns the elongation, m, for a growth of the squared length, m2, without cancellation.
  double elongation(std::size_t cross, double growth) const {
    return growth / (length(cross, growth) + rest_length_of(cross));
  }
  double stiffness_of(std::size_t cross) const { return cross == 0 ? stiffness : cross_stiffness; }
};

}  // namespace hyperlattice
