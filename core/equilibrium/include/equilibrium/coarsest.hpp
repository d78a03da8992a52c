// The direct solver of multigrid's coarsest level: a sparse Cholesky factorisation of its K.
#pragma once

#include <equilibrium/stencil_level.hpp>

#include <memory>

namespace hyperlattice::equilibrium {

class Coarsest {
 public:
  /// Factorises the stiffness of a level. Throws std::runtime_error if that fails.
  explicit Coarsest(const StencilLevel& level);
  ~Coarsest();
  Coarsest(const Coarsest&) = delete;
  Coarsest& operator=(const Coarsest&) = delete;

  /// Solves K x = b in the layout of the level; only components with stiffness are written.
  void solve(const double* b, double* x) const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

}  // namespace hyperlattice::equilibrium
