// The preconditioner of a structured lattice: geometric multigrid, whose coarse levels are made
// from the tangents of the springs (galerkin.hpp).
#pragma once

#include <equilibrium/coarsest.hpp>
#include <equilibrium/galerkin.hpp>

#include <numerics/geometric_multigrid.hpp>

#include <optional>

namespace hyperlattice::equilibrium {

class SpringMultigrid {
 public:
  explicit SpringMultigrid(const SpringLevel& finest) : finest_(finest) {}

  /// Makes the coarse levels from the present tangents of the finest level. Throws
  /// std::runtime_error if the coarsest level cannot be factorised.
  void build();
  /// Computes z, an approximation of K^-1 r. Needs build() before.
  void apply(const Field& r, Field& z) { cycle_->apply(r, z); }
  std::size_t levels() const { return 1 + coarse_.size(); }

 private:
  const GridLevel& at(std::size_t level) const {
    return level == 0 ? static_cast<const GridLevel&>(finest_) : *coarse_[level - 1];
  }

  const SpringLevel& finest_;
  std::vector<std::unique_ptr<StencilLevel>> coarse_;
  std::unique_ptr<Coarsest> coarsest_;
  std::optional<numerics::GeometricMultigrid> cycle_;
};

}  // namespace hyperlattice::equilibrium
