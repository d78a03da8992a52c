// The coarsest level, solved at once by a sparse factorisation.
#pragma once

#include "stencil_level.hpp"

#include <memory>

namespace hyperlattice::statics {

class Coarsest {
 public:
  explicit Coarsest(const StencilLevel& level);
  ~Coarsest();
  Coarsest(const Coarsest&) = delete;
  Coarsest& operator=(const Coarsest&) = delete;

  void solve(const double* b, double* x) const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

}  // namespace hyperlattice::statics
