// The corners of the cubes at rest, as they are drawn: on the grid, or moved to a smooth surface.
#pragma once

#include "body_grid.hpp"

#include <unordered_map>

namespace hyperlattice::render {

class RestCorners {
 public:
  RestCorners() = default;
  /// Moves the corners at the surface of the body by so many steps of Taubin's method, which
  /// smooths the steps of a surface and keeps the volume (Taubin, Curve and surface smoothing
  /// without shrinkage, 1995). Cracks do not matter: both their sides stay together.
  RestCorners(const BodyGrid& grid, int steps);

  /// Returns the place of a corner, m.
  Vec3 at(const BodyGrid& grid, Place corner) const {
    if (!moved_.empty())
      if (const auto found = moved_.find(grid.corner_index(corner)); found != moved_.end())
        return found->second;
    return grid.corner(corner);
  }

 private:
  std::unordered_map<std::uint64_t, Vec3> moved_;  ///< by the index of the corner
};

/// The corners of the face of a cube in each direction, 2 axis + 1 along an axis: bit 0 of a corner
/// is along x, bit 1 along y, bit 2 along z. Seen from outside they go against the clock.
inline constexpr int face_corners[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                           {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};

inline Place corner_of(Place cube, int n) {
  return {cube.i + (n & 1), cube.j + (n >> 1 & 1), cube.k + (n >> 2)};
}
inline Place neighbour_of(Place cube, int direction) {
  return cube.moved(direction / 2, direction % 2 == 0 ? -1 : 1);
}

}  // namespace hyperlattice::render
