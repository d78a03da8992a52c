// How the surroundings of a particle move with it: its deformation gradient.
#pragma once

#include <hyperlattice/plain.hpp>

#include <array>

namespace hyperlattice::render {

/// The rows of a matrix of 3 by 3.
using Matrix = std::array<Vec3, 3>;

inline Vec3 operator*(const Matrix& m, Vec3 v) {
  return {dot(m[0], v), dot(m[1], v), dot(m[2], v)};
}

/// Sums over the neighbours that hold to a particle, from which its deformation gradient follows.
class LocalMotion {
 public:
  /// Adds a neighbour that is at `rest` from the particle at rest, and at `now` now, m.
  void add(Vec3 rest, Vec3 now) {
    for (std::size_t row = 0; row < 3; ++row) {
      moment_[row] += rest[row] * rest;
      moved_[row] += now[row] * rest;
    }
  }
  /// Returns the deformation gradient F that minimises the sum of |now - F rest|^2. Along
  /// directions in which the particle has no neighbour, F is a rotation: that of the other
  /// directions.
  Matrix gradient() const;

 private:
  Matrix moment_{}, moved_{};
};

}  // namespace hyperlattice::render
