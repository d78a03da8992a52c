// A preconditioner on boxes of sites: one V-cycle of geometric multigrid (Briggs, Henson and
// McCormick 2000). Chebyshev polynomials of the block diagonal smooth every level, before and after
// the coarser one, so that the whole is symmetric.
#pragma once

#include <numerics/trilinear_transfer.hpp>

#include <functional>

namespace hyperlattice::numerics {

class GeometricMultigrid {
 public:
  using Solve = std::function<void(const double* b, double* x)>;
  /// Levels from the finest on, which must outlive this, and the way from each to the next;
  /// coarsest: x = K^-1 b of the last level, which may throw.
  GeometricMultigrid(std::vector<const GridLevel*> levels, std::vector<TrilinearTransfer> transfers,
                     Solve coarsest);

  /// z, about K^-1 r, as the finest level's layout has them.
  void apply(const Field& r, Field& z);

 private:
  struct Work {
    Field b, x, r, d, t;
    explicit Work(std::size_t size) : b(size, 0), x(size, 0), r(size, 0), d(size, 0), t(size, 0) {}
  };
  void cycle(std::size_t level);
  void smooth(const GridLevel& level, Work& work, bool from_zero);

  std::vector<const GridLevel*> levels_;
  std::vector<TrilinearTransfer> transfers_;
  Solve coarsest_;
  std::vector<Work> work_;
};

}  // namespace hyperlattice::numerics
