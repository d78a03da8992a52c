// A preconditioner on boxes of sites: one V-cycle of geometric multigrid (Briggs, Henson and
// McCormick 2000). Chebyshev polynomials of the block diagonal smooth every level, before and after
// the coarser one, so that the preconditioner is symmetric.
#pragma once

#include <numerics/trilinear_transfer.hpp>

#include <functional>

namespace hyperlattice::numerics {

class GeometricMultigrid {
 public:
  using Solve = std::function<void(const double* b, double* x)>;
  /// `levels`: from the finest on; they must outlive this object. `transfers`: from each level to
  /// the next. `coarsest`: computes x = K^-1 b on the last level; may throw.
  GeometricMultigrid(std::vector<const GridLevel*> levels, std::vector<TrilinearTransfer> transfers,
                     Solve coarsest);

  /// Computes z, about K^-1 r, in the layout of the finest level.
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
