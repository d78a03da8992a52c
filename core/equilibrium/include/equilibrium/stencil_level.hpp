// A coarse level of multigrid: blocks of 4 x 4 between each site and its neighbours. The forward
// half is stored, once for all sites with equal blocks. Bodies without heights use three rows of a
// block.
#pragma once

#include <equilibrium/numerics.hpp>
#include <equilibrium/rows.hpp>
#include <equilibrium/signatures.hpp>

namespace hyperlattice::equilibrium {

class StencilLevel : public GridLevel {
 public:
  /// Makes a level of zero stiffness on a box of sites, with neighbours up to `reach` sites away
  /// along each axis. Sites of one signature form a kind; its blocks are summed at the first of
  /// them.
  StencilLevel(const std::array<std::int64_t, 3>& sites, int reach, const Signatures& signatures,
               int threads);

  /// Returns the block of a place with itself (neighbour 0) or with a forward neighbour, [a][b].
  const double* block(std::int64_t place, std::size_t neighbour) const {
    return blocks_.data() + at(kind_[static_cast<std::size_t>(place)], neighbour);
  }
  /// Returns the same block to be summed; null if the block is not made at this place.
  double* making(std::int64_t place, std::size_t neighbour) {
    const std::int32_t kind = making_[static_cast<std::size_t>(place)];
    return kind < 0 ? nullptr : blocks_.data() + at(kind, neighbour);
  }
  BlockSums sums(std::int64_t place) {
    return {blocks_.data(), making_.data() + place, static_cast<std::int64_t>(stride())};
  }
  Signatures signatures() const;
  /// Returns the number of the forward neighbour at (di, dj, dk): 0 for the site itself, and -n for
  /// a backward neighbour that is opposite to the forward neighbour n.
  int neighbour(std::int64_t di, std::int64_t dj, std::int64_t dk) const {
    const std::int64_t width = 2 * reach_ + 1;
    return static_cast<int>((dk * width + dj) * width + di);
  }
  std::size_t stride() const { return steps_.size() + 1; }  ///< number of blocks of a place
  /// Returns the steps to the forward neighbours 1, 2, ..., places.
  const std::vector<std::int64_t>& steps() const { return steps_; }
  int reach() const { return reach_; }
  bool makes(std::int64_t place) const { return making_[static_cast<std::size_t>(place)] >= 0; }

  /// Inverts the diagonal blocks and estimates the largest eigenvalue; call after all sums.
  void finish();
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
  std::vector<std::int32_t> kind_, making_;  ///< kind of each place (0: margin); see BlockSums
  std::size_t kinds_ = 1;
  Field blocks_, inverse_;
  double largest_eigenvalue_ = 2;
};

}  // namespace hyperlattice::equilibrium
