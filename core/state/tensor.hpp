// 3 x 3 tensors of the deformation and the stress of a body.
#pragma once

#include <hyperlattice/plain.hpp>

#include <array>
#include <limits>

namespace hyperlattice {

/// A tensor T with the components T[row][column]; its nine numbers stand in memory row by row.
struct Tensor {
  std::array<Vec3, 3> rows;

  const Vec3& operator[](std::size_t row) const { return rows[row]; }
  Vec3& operator[](std::size_t row) { return rows[row]; }
  Tensor& operator+=(const Tensor& b) {
    for (std::size_t n = 0; n < 3; ++n) rows[n] += b[n];
    return *this;
  }
  friend Tensor operator+(Tensor a, const Tensor& b) { return a += b; }
  friend Tensor operator*(double s, const Tensor& a) { return {{s * a[0], s * a[1], s * a[2]}}; }
};
static_assert(sizeof(Tensor) == 9 * sizeof(double));

/// All numbers are NaN: where a tensor is not defined.
inline constexpr Tensor no_tensor = [] {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  return Tensor{{Vec3{nan, nan, nan}, Vec3{nan, nan, nan}, Vec3{nan, nan, nan}}};
}();
inline constexpr Tensor identity{{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}};

/// Returns a (x) b.
inline Tensor outer(Vec3 a, Vec3 b) { return {{a.x * b, a.y * b, a.z * b}}; }
inline Vec3 operator*(const Tensor& a, Vec3 b) {
  return {dot(a[0], b), dot(a[1], b), dot(a[2], b)};
}
inline Tensor transposed(const Tensor& a) {
  return {
      {Vec3{a[0].x, a[1].x, a[2].x}, Vec3{a[0].y, a[1].y, a[2].y}, Vec3{a[0].z, a[1].z, a[2].z}}};
}
inline Tensor operator*(const Tensor& a, const Tensor& b) {
  const Tensor columns = transposed(b);
  return {{columns * a[0], columns * a[1], columns * a[2]}};
}
inline double trace(const Tensor& a) { return a[0].x + a[1].y + a[2].z; }
/// Returns the cofactor: det(T) times the inverse of the transpose.
inline Tensor cofactor(const Tensor& a) {
  return {{cross(a[1], a[2]), cross(a[2], a[0]), cross(a[0], a[1])}};
}
inline double determinant(const Tensor& a) { return dot(a[0], cross(a[1], a[2])); }

/// Returns J - 1 with J = det(I + H), without cancellation.
inline double volume_change(const Tensor& H) {
  const Tensor c = cofactor(H);
  return trace(H) + trace(c) + determinant(H);
}

/// The six numbers of a symmetric tensor: xx yy zz yz xz xy, the order of Voigt.
using Symmetric = std::array<double, 6>;
/// Returns the symmetric part (T + T^T) / 2.
inline Symmetric symmetric_part(const Tensor& a) {
  return {a[0].x,
          a[1].y,
          a[2].z,
          0.5 * (a[1].z + a[2].y),
          0.5 * (a[0].z + a[2].x),
          0.5 * (a[0].y + a[1].x)};
}

}  // namespace hyperlattice
