// The properties of one spring of the body.
#pragma once

#include <model/composite_spring.hpp>

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
  double stiffness_of(std::size_t cross) const { return cross == 0 ? stiffness : cross_stiffness; }
};

}  // namespace hyperlattice
