// The system of a listed lattice with aggregation multigrid as preconditioner. The finest level is
// smoothed on the tangent itself; aggregation makes the coarser levels.
#pragma once

#include <equilibrium/listed_system.hpp>

#include <numerics/aggregation_multigrid.hpp>
#include <numerics/chebyshev_smoother.hpp>

#include <optional>

namespace hyperlattice::equilibrium {

class AggregatedSystem : public ListedSystem {
 public:
  explicit AggregatedSystem(const StaticProblem& problem);

  double linearise(const Field& displacement, Field& force) override;
  void prepare() override;
  std::span<const double> made_from() const override { return made_from_; }
  void make_again(std::span<const double> from) override;
  void apply(const Field& r, Field& z) override;

 private:
  numerics::BlockJacobi own_blocks() const;
  numerics::SparseRows rows() const;
  bool is_near(const Field& displacement) const;
  void make_levels();

  Field present_, made_at_;  ///< displacements of the present tangent, and of the tangent for which
                             ///< the levels were made (empty: none)
  double pull_made_at_ = 0, own_made_at_ = 0;  ///< largest_pull() and largest_own() at made_at_
  std::vector<double> made_from_;              ///< the tangents there
  std::optional<numerics::ChebyshevSmoother> smoother_;
  std::optional<numerics::AggregationMultigrid> below_;
  Field rest_;
  Eigen::VectorXd right_, left_;  ///< by particle and component, the order of the levels
};

}  // namespace hyperlattice::equilibrium
