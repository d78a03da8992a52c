// Images of solids: a box of equal cubes, each with a value.
#pragma once

#include <hyperlattice/plain.hpp>

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace hyperlattice {

enum class VoxelType : std::uint32_t { uint8, uint16 };  ///< uint16: little-endian

/// The voxels of an image that have one of some values.
class VoxelSet {
 public:
  /// Of the bytes of a raw image, x running fastest, then y, then z. `values`: those inside; empty:
  /// all but 0. Throws std::runtime_error, with a sentence, if the bytes are not so many voxels, or
  /// if no voxel is inside, or none has one of the values.
  VoxelSet(std::string_view bytes, const std::array<std::int64_t, 3>& counts, VoxelType type,
           const std::vector<double>& values, Vec3 low, double edge);

  /// A point between voxels is in the one with the larger coordinates, so that images that fill
  /// space fill it once; at the image's end in the last.
  bool contains(Vec3 point) const;
  Vec3 low() const { return corner(first_); }
  Vec3 high() const {
    return corner({last_[0] + 1, last_[1] + 1, last_[2] + 1});
  }  ///< of the box around the voxels inside

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

  Index counts_, first_{}, last_{};
  Vec3 low_;
  double edge_;
  std::vector<bool> inside_;
};

}  // namespace hyperlattice
