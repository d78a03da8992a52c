// The corners of the drawn cubes, shared by all cubes that hold together around them.
#pragma once

#include "body_surface.hpp"

#include <unordered_map>

namespace hyperlattice::render {

class Corners {
 public:
  explicit Corners(const DrawnBody& body) : body_(body) {}

  /// Returns the index of corner `n`, 0 to 7, of a cube: bit 0 along x, bit 1 along y, bit 2 along
  /// z.
  std::uint32_t index(Place cube, int n);
  /// Returns the places of all corners, m, by their indices.
  std::vector<Vec3> places() const;

 private:
  /// A corner: its place in the grid, and which of the eight cubes around it hold together.
  struct Corner {
    std::uint64_t place = 0;
    std::uint8_t cubes = 0;
  };

  /// Returns the cubes, a bit for each, that hold together with cube `n` around a corner.
  std::uint8_t cubes_with(Place corner, int n) const;

  const DrawnBody& body_;
  std::vector<Corner> corners_;
  std::unordered_map<std::uint64_t, std::uint32_t> index_;  ///< by place and lowest cube
};

/// Returns cube `n` of the eight around a corner.
inline Place cube_around(Place corner, int n) {
  return {corner.i - 1 + (n & 1), corner.j - 1 + (n >> 1 & 1), corner.k - 1 + (n >> 2)};
}

}  // namespace hyperlattice::render
