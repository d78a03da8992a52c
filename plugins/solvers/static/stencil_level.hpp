// A coarse level: blocks of 4 x 4 between each site and those around it, of which the forward half is stored. Three-dimensional bodies use three
// rows of a block.
#pragma once

#include "level.hpp"
#include "rows.hpp"

namespace hyperlattice::statics {

class StencilLevel : public Level {
 public:
  /// Zero stiffness on a box of sites, between sites up to `reach` apart along each axis.
  StencilLevel(const std::array<std::int64_t, 3>& sites, int reach, int threads);

  /// The block of a site and itself (0), or one of its forward neighbours.
  double* block(std::int64_t place, std::size_t neighbour) { return blocks_.data() + 16 * (static_cast<std::size_t>(place) * stride() + neighbour); }
  const double* block(std::int64_t place, std::size_t neighbour) const {
    return blocks_.data() + 16 * (static_cast<std::size_t>(place) * stride() + neighbour);
  }
  /// Which forward neighbour is (di, dj, dk) away; 0: the site itself; below 0: it is a backward one, whose opposite is neighbour -n.
  int neighbour(std::int64_t di, std::int64_t dj, std::int64_t dk) const {
    const std::int64_t width = 2 * reach_ + 1;
    return static_cast<int>((dk * width + dj) * width + di);
  }
  std::size_t stride() const { return steps_.size() + 1; }           ///< blocks of a place
  const std::vector<std::int64_t>& steps() const { return steps_; }  ///< places to the forward neighbours 1, 2, ...
  int reach() const { return reach_; }

  void finish();  ///< once all blocks are added
  void multiply(const double* x, double* y) const override;
  void divide(const double* r, double* z) const override;
  void mask(double*) const override {}
  double largest_eigenvalue() const override { return largest_eigenvalue_; }

 private:
  int reach_;
  std::vector<std::int64_t> steps_;
  Field blocks_, inverse_;
  double largest_eigenvalue_ = 2;
};

}  // namespace hyperlattice::statics
