// Which neighbouring particles do not hold together.
#pragma once

#include <hyperlattice/output.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace hyperlattice::render {

class BrokenPairs {
 public:
  /// `fragments`: the piece of each particle; empty: the body has one piece.
  BrokenPairs(std::uint64_t particles, std::span<const double> fragments)
      : is_touched_(particles, false), fragments_(fragments) {}

  /// Adds the ends of the springs of these faces.
  void add(std::span<const CrackFace> faces) {
    for (const CrackFace& face : faces) {
      pairs_.emplace_back(std::min(face.a, face.b), std::max(face.a, face.b));
      is_touched_[face.a] = is_touched_[face.b] = true;
    }
  }
  /// Ends the adding.
  void sort() {
    std::sort(pairs_.begin(), pairs_.end());
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
  }

  /// Returns whether any spring of the particle is broken.
  bool is_touched(Particle particle) const { return is_touched_[particle]; }
  /// Returns whether two neighbours hold together: their spring is not broken, and they belong to
  /// one piece.
  bool joins(Particle a, Particle b) const {
    if (a == b || !is_touched_[a] || !is_touched_[b]) return true;
    if (!fragments_.empty() && fragments_[a] != fragments_[b]) return false;
    return !std::binary_search(pairs_.begin(), pairs_.end(),
                               std::pair(std::min(a, b), std::max(a, b)));
  }

 private:
  std::vector<std::pair<Particle, Particle>> pairs_;
  std::vector<bool> is_touched_;
  std::span<const double> fragments_;
};

}  // namespace hyperlattice::render
