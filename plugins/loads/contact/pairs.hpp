// Which particles may meet: all pairs that are nearer than a reach and a margin, found anew when
// particles have moved by half the margin.
#pragma once

#include <hyperlattice/load.hpp>

#include <cstdint>
#include <vector>

namespace hyperlattice::contact {

class Pairs {
 public:
  Pairs() = default;
  /// Of points, metres; `reach`: within which pairs are asked for, metres.
  Pairs(std::vector<Vec3> at_rest, double reach) : at_rest_(std::move(at_rest)), reach_(reach) {}

  /// For points at these displacements.
  void find(std::span<const Vec3> displacement);

  /// Others that may be within reach of point n, ascending: what is summed over them does not
  /// depend on when they were found.
  std::span<const std::uint32_t> of(std::size_t n) const {
    return {other_.data() + first_[n], other_.data() + first_[n + 1]};
  }
  /// From point a to point b; the other way round exactly the opposite.
  Vec3 apart(std::size_t a, std::size_t b, std::span<const Vec3> displacement) const {
    return (at_rest_[b] - at_rest_[a]) + (displacement[b] - displacement[a]);
  }
  double apart_at_rest(std::size_t a, std::size_t b) const {
    return norm(at_rest_[b] - at_rest_[a]);
  }

 private:
  static constexpr double margin = 0.3;  ///< of the reach
  bool have_moved(std::span<const Vec3> displacement) const;

  std::vector<Vec3> at_rest_;
  double reach_ = 0;
  std::vector<Vec3> found_at_;  ///< displacements
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> other_;
};

}  // namespace hyperlattice::contact
