// A coarse level: blocks of 4 x 4 between each site and those around it, of which the forward half
// is stored, once for all sites that are alike. Three-dimensional bodies use three rows of a block.
#pragma once

#include "numerics.hpp"
#include "rows.hpp"
#include "signatures.hpp"

namespace hyperlattice::statics {

class StencilLevel : public GridLevel {
 public:
  /// Zero stiffness on a box of sites, between sites up to `reach` apart along each axis. Sites of
  /// one signature are of one kind, whose blocks are made at the first of them.
  StencilLevel(const std::array<std::int64_t, 3>& sites, int reach, const Signatures& signatures,
               int threads);

  /// The block of a site and itself (0), or one of its forward neighbours.
  const double* block(std::int64_t place, std::size_t neighbour) const {
    return blocks_.data() + at(kind_[static_cast<std::size_t>(place)], neighbour);
  }
  /// The same to add to; null where none is made.
  double* making(std::int64_t place, std::size_t neighbour) {
    const std::int32_t kind = making_[static_cast<std::size_t>(place)];
    return kind < 0 ? nullptr : blocks_.data() + at(kind, neighbour);
  }
  BlockSums sums(std::int64_t place) {
    return {blocks_.data(), making_.data() + place, static_cast<std::int64_t>(stride())};
  }
  Signatures signatures() const;
  /// Which forward neighbour is (di, dj, dk) away; 0: the site itself; below 0: it is a backward
  /// one, whose opposite is neighbour -n.
  int neighbour(std::int64_t di, std::int64_t dj, std::int64_t dk) const {
    const std::int64_t width = 2 * reach_ + 1;
    return static_cast<int>((dk * width + dj) * width + di);
  }
  std::size_t stride() const { return steps_.size() + 1; }  ///< blocks of a place
  const std::vector<std::int64_t>& steps() const {
    return steps_;
  }  ///< places to the forward neighbours 1, 2, ...
  int reach() const { return reach_; }
  bool makes(std::int64_t place) const { return making_[static_cast<std::size_t>(place)] >= 0; }

  void finish();  ///< once all blocks are added
  void multiply(const double* x, double* y) const override;
  void divide(std::size_t first, std::size_t last, const double* r, double* z) const override;
  void mask(double*) const override {}
  double largest_eigenvalue() const override { return largest_eigenvalue_; }

 private:
  std::size_t at(std::int32_t kind, std::size_t neighbour) const {
    return 16 * (static_cast<std::size_t>(kind) * stride() + neighbour);
  }

  int reach_;
  std::vector<std::int64_t> steps_;
  std::vector<std::int32_t> kind_, making_;  ///< of each place; 0: of the margin
  std::size_t kinds_ = 1;
  Field blocks_, inverse_;
  double largest_eigenvalue_ = 2;
};

}  // namespace hyperlattice::statics
