// The cubes of the body at rest: see BodyCubes.
#pragma once

#include <hyperlattice/output.hpp>

#include <utility>
#include <vector>

namespace hyperlattice::render {

/// A place in the grid of cubes, or of their corners.
struct Place {
  std::int32_t i = 0, j = 0, k = 0;

  Place moved(int axis, std::int32_t by) const {
    Place place = *this;
    (axis == 0 ? place.i : axis == 1 ? place.j : place.k) += by;
    return place;
  }
};

/// A copy of the cubes, which the snapshot frees.
class BodyGrid {
 public:
  static constexpr std::uint32_t none = BodyCubes::no_particle;

  BodyGrid() = default;
  explicit BodyGrid(const BodyCubes& cubes)
      : origin_(cubes.origin),
        edge_(cubes.edge),
        count_{cubes.count[0], cubes.count[1], cubes.count[2]},
        particle_(cubes.particle.begin(), cubes.particle.end()) {}

  bool empty() const { return particle_.empty(); }
  double edge() const { return edge_; }  ///< m
  std::int32_t count(int axis) const { return count_[axis]; }
  /// Returns the particle of a cube; none outside the body.
  std::uint32_t particle(Place cube) const {
    if (cube.i < 0 || cube.j < 0 || cube.k < 0 || cube.i >= count_[0] || cube.j >= count_[1] ||
        cube.k >= count_[2])
      return none;
    return particle_[index(cube, 0)];
  }
  /// Returns the number of a corner among all corners of the grid.
  std::uint64_t corner_index(Place corner) const { return index(corner, 1); }
  Place corner_place(std::uint64_t index) const {
    const auto [nx, ny] = row_sizes(1);
    return {static_cast<std::int32_t>(index % nx), static_cast<std::int32_t>(index / nx % ny),
            static_cast<std::int32_t>(index / nx / ny)};
  }
  /// Returns the place of a corner at rest, m.
  Vec3 corner(Place corner) const {
    return origin_ + edge_ * Vec3{double(corner.i), double(corner.j), double(corner.k)};
  }
  Vec3 centre(Place cube) const { return corner(cube) + Vec3{edge_ / 2, edge_ / 2, edge_ / 2}; }

 private:
  /// Returns the number of cubes along x and y, or with `more` = 1 that of corners.
  std::pair<std::uint64_t, std::uint64_t> row_sizes(std::uint64_t more) const {
    return {static_cast<std::uint64_t>(count_[0]) + more,
            static_cast<std::uint64_t>(count_[1]) + more};
  }
  std::uint64_t index(Place place, std::uint64_t more) const {
    const auto [nx, ny] = row_sizes(more);
    return (static_cast<std::uint64_t>(place.k) * ny + static_cast<std::uint64_t>(place.j)) * nx +
           static_cast<std::uint64_t>(place.i);
  }

  Vec3 origin_;
  double edge_ = 0;
  std::int32_t count_[3] = {};
  std::vector<std::uint32_t> particle_;
};

}  // namespace hyperlattice::render
