// A listed lattice with algebraic multigrid. The first level is smoothed here, a particle at a time; what is left goes through a V-cycle of hypre.
#pragma once

#include "block_smoother.hpp"
#include "boomer.hpp"

#include <optional>

namespace hyperlattice::statics {

class AmgSystem : public ListedSystem {
 public:
  AmgSystem(const StaticProblem& problem, double strong_threshold);

  double linearise(const Field& displacement, Field& force) override;
  void prepare() override;
  void apply(const Field& r, Field& z) override;

 private:
  SparseRows rows() const;
  bool is_near(const Field& displacement) const;
  void cycle(const Field& r, Field& z);

  double strong_threshold_;
  Field present_, made_at_;  ///< displacements: of the tangent, and of the one that multigrid was made for; empty: none
  std::optional<BlockSmoother> smoother_;
  std::optional<Boomer> multigrid_;
  Field rest_, correction_, right_, left_;  ///< the last two by particle and component, as multigrid counts
};

}  // namespace hyperlattice::statics
