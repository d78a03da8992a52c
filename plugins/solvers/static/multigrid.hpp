// The preconditioner: one V-cycle of geometric multigrid. Chebyshev polynomials of the block diagonal smooth every level, before
// and after the coarser one, so that the whole is symmetric.
#pragma once

#include "coarsest.hpp"
#include "galerkin.hpp"

namespace hyperlattice::statics {

class Multigrid {
 public:
  explicit Multigrid(const SpringLevel& finest) : finest_(finest) {}

  void build();  ///< the coarse levels, from the finest's present tangents
  /// z, about K^-1 r.
  void apply(const Field& r, Field& z);
  std::size_t levels() const { return 1 + coarse_.size(); }

 private:
  struct Work {
    Field b, x, r, d, t;
    explicit Work(std::size_t size) : b(size, 0), x(size, 0), r(size, 0), d(size, 0), t(size, 0) {}
  };
  void cycle(std::size_t level);
  void smooth(const Level& level, Work& work, bool from_zero);
  const Level& at(std::size_t level) const { return level == 0 ? static_cast<const Level&>(finest_) : *coarse_[level - 1]; }

  const SpringLevel& finest_;
  std::vector<Transfer> transfers_;
  std::vector<std::unique_ptr<StencilLevel>> coarse_;
  std::unique_ptr<Coarsest> coarsest_;
  std::vector<Work> work_;
};

}  // namespace hyperlattice::statics
