// Means over the cells around each particle.
#pragma once

#include <state/cell_stress.hpp>

#include <vector>

namespace hyperlattice {

/// Sums values of cells at their corners, with the cells' shares as weights. T has += and a
/// product with a number. A visitor of for_cells() may add.
template <class T>
class CornerMeans {
 public:
  explicit CornerMeans(std::uint64_t particles) : sums_(particles), weights_(particles, 0) {}

  void add(const PresentCell& cell, const T& value) {
    const T part = cell.share * value;
    for (const Particle corner : cell.corners) {
      sums_[corner] += part;
      weights_[corner] += cell.share;
    }
  }
  /// Returns whether a cell around the particle has a value.
  bool has(Particle particle) const { return weights_[particle] > 0; }
  /// Returns the mean of each particle, and `none` where no cell has a value. Call it once.
  std::vector<T> take(const T& none) {
    for (std::size_t n = 0; n < sums_.size(); ++n)
      sums_[n] = weights_[n] > 0 ? 1 / weights_[n] * sums_[n] : none;
    return std::move(sums_);
  }

 private:
  std::vector<T> sums_;
  std::vector<double> weights_;
};

}  // namespace hyperlattice
