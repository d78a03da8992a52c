// A strength surface: the stresses at which damage starts to grow. A body whose material has one
// cracks by a field of damage between 0 and 1 (see docs/theory/cohesive.md), so strength, fracture
// energy and elasticity are independent inputs, and a crack does not follow the lattice. The
// surface says only how close a stress is to it:
//
//   struct Options : CohesiveOptions { double friction = 0; };
//   double ratio(const PrincipalStress& stress) const;   // 1 on the surface
//
// The core computes the stress, lets damage grow and softens the springs.
#pragma once

#include <hyperlattice/component.hpp>

#include <span>

namespace hyperlattice {

/// Principal values of the effective Cauchy stress, Pa, tension positive: first >= second >= third.
struct PrincipalStress {
  double first = 0, second = 0, third = 0;
};

/// What every cohesive material needs besides its surface. A surface's Options derive from it.
struct CohesiveOptions {
  double strength = 0;         ///< sigma_t, uniaxial tensile strength, Pa
  double fracture_energy = 0;  ///< G_c, J/m2
  double length = 0;           ///< b, internal length, m; 0: the largest that the inputs allow
  double weibull_modulus = 0;  ///< scatter of the strength between particles; 0: none
  std::uint64_t seed = 1;      ///< of the scatter
};

/// Functions of a strength surface across the boundary: part of FailureFunctions.
struct SurfaceFunctions {
  /// Null: the component is a criterion of springs.
  void (*inputs)(const void* surface, CohesiveOptions& inputs) noexcept;
  /// Writes the ratio for each stress.
  bool (*ratios)(const void* surface, std::span<const PrincipalStress> stresses, double* ratios,
                 const Complaint& why) noexcept;
};

/// A surface has: `double ratio(const PrincipalStress&) const`, 0 where no damage can start, 1 on
/// the surface, and homogeneous of degree 1: twice the stress has twice the ratio. In uniaxial
/// tension it is sigma / strength.
template <class T>
concept SurfaceComponent = requires(const T& surface, const PrincipalStress& stress) {
  { surface.ratio(stress) } -> std::convertible_to<double>;
};

}  // namespace hyperlattice
