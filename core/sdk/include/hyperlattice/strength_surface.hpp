// A strength surface: the stresses at which damage starts to grow. A body whose material has one
// cracks by a field of damage between 0 and 1 (docs/theory/cohesive.md), so strength, fracture
// energy and elasticity are independent inputs, and a crack does not follow the lattice. The
// surface says only how close a stress is to it:
//
//   struct Options : CohesiveOptions { double friction = 0; };
//   static Schema<Options> schema() {
//     Schema<Options> schema("failures.my_surface", "...");
//     return CohesiveOptions::declare(schema).add<&Options::friction>("friction", "", "...");
//   }
//   double ratio(const PrincipalStress& stress) const;   // 1 on the surface
//
// The core computes the stress, lets damage grow and softens the springs.
#pragma once

#include <hyperlattice/component.hpp>

#include <cmath>
#include <concepts>
#include <cstdint>
#include <optional>
#include <span>

namespace hyperlattice {

/// Principal values of the effective Cauchy stress, Pa, tension positive: first >= second >= third.
struct PrincipalStress {
  double first = 0, second = 0, third = 0;

  double trace() const { return first + second + third; }
  /// Returns the equivalent stress of von Mises, sqrt(3 J2): that of uniaxial tension is its
  /// stress.
  double von_mises() const {
    const double a = first - second, b = second - third, c = third - first;
    return std::sqrt((a * a + b * b + c * c) / 2);
  }
};

/// What the damage of a material needs besides its surface.
struct CohesiveInputs {
  double strength = 0;         ///< sigma_t, uniaxial tensile strength, Pa
  double fracture_energy = 0;  ///< G_c, J/m2
  double length = 0;           ///< b, internal length, m; 0: the largest that the inputs allow
  double weibull_modulus = 0;  ///< scatter of the strength between particles; 0: none
  std::uint64_t seed = 1;      ///< of the scatter
  bool allow_coarse = false;   ///< accept fewer than three spacings in the length
  /// No damage near particles whose motion a load prescribes.
  bool intact_near_supports = true;
};

/// Options that all surfaces have. A surface's own Options derive from them.
struct CohesiveOptions {
  double strength = 0, fracture_energy = 0;
  std::optional<double> length, weibull_modulus;
  std::uint64_t seed = 1;
  bool allow_coarse = false, intact_near_supports = true;

  /// Adds these options to a schema.
  template <class Of>
  static Schema<Of>& declare(Schema<Of>& schema) {
    return schema
        .template add<&Of::strength>("strength", "Pa", "sigma_t, strength in uniaxial tension")
        .positive()
        .example("\"4 MPa\"")
        .template add<&Of::fracture_energy>("fracture_energy", "J/m2",
                                            "G_c, energy that a unit of area of a crack takes")
        .positive()
        .example("10")
        .template add<&Of::length>(
            "length", "m",
            "b, internal length: the band of a crack is pi b wide. Left out: the largest that "
            "strength, fracture energy and stiffness allow, 8 C11 G_c / (3 pi sigma_t^2) less "
            "0.175 spacings. A study of several spacings gives the same to all")
        .positive()
        .template add<&Of::weibull_modulus>(
            "weibull_modulus", "",
            "the strengths of particles have a Weibull distribution of this modulus, with strength "
            "as their mean; the fracture energy stays. Left out: no scatter")
        .positive()
        .template add<&Of::seed>("seed", "", "of the scatter")
        .at_most(1LL << 53)
        .fallback("1")
        .template add<&Of::allow_coarse>(
            "allow_coarse", "",
            "accept a length of fewer than 3 spacings, where the energy of a crack depends on its "
            "direction by 10 % and more")
        .fallback("false")
        .template add<&Of::intact_near_supports>(
            "intact_near_supports", "",
            "no damage nearer than pi b / 2 to a particle whose motion a load prescribes: else the "
            "clamping starts cracks")
        .fallback("true");
  }

  CohesiveInputs inputs() const {
    return {strength, fracture_energy, length.value_or(0),  weibull_modulus.value_or(0),
            seed,     allow_coarse,    intact_near_supports};
  }
};

/// Functions of a strength surface across the boundary: part of FailureFunctions. Both are null in
/// a criterion of springs.
struct SurfaceFunctions {
  void (*inputs)(const void* surface, CohesiveInputs& inputs) noexcept;
  /// Writes the ratio for each stress.
  bool (*ratios)(const void* surface, std::span<const PrincipalStress> stresses, double* ratios,
                 const Complaint& why) noexcept;
};

/// A surface has: `double ratio(const PrincipalStress&) const`, 0 where no damage can start, 1 on
/// the surface, and homogeneous of degree 1: twice the stress has twice the ratio. In uniaxial
/// tension it is sigma / strength. It should be convex in the stress. Options derives from
/// CohesiveOptions.
template <class T>
concept SurfaceComponent = requires(const T& surface, const PrincipalStress& stress) {
  { surface.ratio(stress) } -> std::convertible_to<double>;
  requires std::derived_from<typename T::Options, CohesiveOptions>;
};

namespace detail {
/// A surface and the options of its damage.
template <SurfaceComponent T>
struct WithInputs {
  explicit WithInputs(const typename T::Options& options)
      : inputs(options.inputs()), surface(options) {}
  CohesiveInputs inputs;
  T surface;
};

template <SurfaceComponent T>
struct Held<T> {
  using type = WithInputs<T>;
};
}  // namespace detail
}  // namespace hyperlattice

#include <hyperlattice/failure.hpp>  // the table of functions of a surface
