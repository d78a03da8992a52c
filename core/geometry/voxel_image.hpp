// Images of solids: a box of equal cubes (voxels), each with a value.
#pragma once

#include <geometry/solid_surface.hpp>

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace hyperlattice {

/// type of a voxel's value; uint16 is little-endian
enum class VoxelType : std::uint32_t { uint8, uint16 };

/// The voxels of an image whose values are in a given set.
class VoxelSet final : public FacetedSolid {
 public:
  /// Reads a raw image, x fastest, then y, then z. `values`: values of voxels inside; empty: all
  /// but 0. `low`: corner of the image, m; `edge`: edge of a voxel, m. Throws std::runtime_error
  /// with a sentence if the number of bytes is wrong, if no voxel is inside, or if no voxel has one
  /// of the values.
  VoxelSet(std::string_view bytes, const std::array<std::int64_t, 3>& counts, VoxelType type,
           const std::vector<double>& values, Vec3 low, double edge);

  /// Returns whether a point is in a voxel of the set. A point on a face between voxels belongs to
  /// the voxel with the larger coordinates, so that images side by side do not overlap; a point on
  /// the image's end belongs to the last voxel.
  bool contains(Vec3 point) const;
  Vec3 low() const { return corner(first_); }
  Vec3 high() const {
    return corner({last_[0] + 1, last_[1] + 1, last_[2] + 1});
  }  ///< corner of the bounding box of the set, m

  Side side_of(const Cube& cube) const override;
  double volume_in(const Cube& cube) const override;
  std::vector<Plane> planes_in(const Cube& cube, std::size_t most) const override;

 private:
  using Index = std::array<std::int64_t, 3>;
  Vec3 corner(const Index& index) const {
    return low_ + edge_ * Vec3{static_cast<double>(index[0]), static_cast<double>(index[1]),
                               static_cast<double>(index[2])};
  }
  std::size_t number(const Index& index) const {
    return static_cast<std::size_t>((index[2] * counts_[1] + index[1]) * counts_[0] + index[0]);
  }
  void find_box();
  /// The voxels that a cube overlaps along one axis, from `first` up to `last`.
  struct Span {
    std::int64_t first, last;
  };
  Span voxels_along(std::size_t axis, const Cube& cube) const;
  /// Returns the length, in voxels, that the cube has in a voxel along the axis.
  double overlap(std::size_t axis, std::int64_t voxel, const Cube& cube) const;

  Index counts_, first_{}, last_{};
  Vec3 low_;
  double edge_;
  std::vector<bool> inside_;
};

}  // namespace hyperlattice
