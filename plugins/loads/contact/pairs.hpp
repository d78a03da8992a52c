// The list of particles that may be in contact: all pairs nearer than reach + margin. The list is
// made again after a particle has moved by half the margin.
#pragma once

#include <hyperlattice/load.hpp>

#include <cstdint>
#include <vector>

namespace hyperlattice::contact {

class Pairs {
 public:
  Pairs() = default;
  /// Takes the positions of points at rest, m, and the reach, m: the largest distance of a pair.
  Pairs(std::vector<Vec3> at_rest, double reach) : at_rest_(std::move(at_rest)), reach_(reach) {}

  /// Updates the list for the given displacements, m, if points have moved far enough.
  void find(std::span<const Vec3> displacement);

  /// Returns the points that may be within reach of point n, ascending, so that a sum over them
  /// does not depend on the time at which the list was made.
  std::span<const std::uint32_t> of(std::size_t n) const {
    return {other_.data() + first_[n], other_.data() + first_[n + 1]};
  }
  /// Returns the vector from point a to point b, m; the vector from b to a is exactly the opposite.
  Vec3 apart(std::size_t a, std::size_t b, std::span<const Vec3> displacement) const {
    return (at_rest_[b] - at_rest_[a]) + (displacement[b] - displacement[a]);
  }
  double apart_at_rest(std::size_t a, std::size_t b) const {
    return norm(at_rest_[b] - at_rest_[a]);
  }

 private:
  static constexpr double margin = 0.3;  ///< over the reach
  bool have_moved(std::span<const Vec3> displacement) const;

  std::vector<Vec3> at_rest_;
  double reach_ = 0;
  std::vector<Vec3> found_at_;  ///< displacements for which the list was made, m
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> other_;
};

}  // namespace hyperlattice::contact
