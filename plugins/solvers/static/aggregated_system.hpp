// A listed lattice with multigrid by aggregation. The finest level is smoothed on the tangent
// itself.
#pragma once

#include "listed_system.hpp"

#include <numerics/aggregation_multigrid.hpp>
#include <numerics/chebyshev_smoother.hpp>

#include <optional>

namespace hyperlattice::statics {

class AggregatedSystem : public ListedSystem {
 public:
  explicit AggregatedSystem(const StaticProblem& problem);

  double linearise(const Field& displacement, Field& force) override;
  void prepare() override;
  void apply(const Field& r, Field& z) override;

 private:
  numerics::BlockJacobi own_blocks() const;
  numerics::SparseRows rows() const;
  bool is_near(const Field& displacement) const;

  Field present_, made_at_;  ///< displacements: of the tangent, and of the one that the levels were
                             ///< made for; empty: none
  double pull_made_at_ = 0;  ///< largest_pull() there
  std::optional<numerics::ChebyshevSmoother> smoother_;
  std::optional<numerics::AggregationMultigrid> below_;
  Field rest_;
  Eigen::VectorXd right_, left_;  ///< by particle and component, as the levels count
};

}  // namespace hyperlattice::statics
