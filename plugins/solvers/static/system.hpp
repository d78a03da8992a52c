// The tangent K of a body, N/m, and what solves K x = b roughly: all that Newton's method and
// conjugate gradients know of a lattice.
#pragma once

#include "numerics.hpp"

#include <numerics/linear_operator.hpp>

#include <hyperlattice/statics.hpp>

#include <functional>

namespace hyperlattice::statics {

class System : public numerics::LinearOperator, public numerics::Preconditioner {
 public:
  explicit System(const StaticProblem& problem) : problem_(problem) {}

  /// Takes the tangents at a displacement; returns the energy stored there, J, and the forces of
  /// the springs.
  virtual double linearise(const Field& displacement, Field& force) = 0;
  // multiply() gives 0 where nothing can move, and mask() sets that to zero.
  virtual void prepare() = 0;  ///< apply(), for the present tangents
  virtual int most_iterations() const {
    return 1000;
  }  ///< of conjugate gradients, in which they find what they can
  virtual double stiffest() const = 0;  ///< largest tangent of a spring, N/m
  virtual double softest_height()
      const = 0;  ///< least stiffness of a height, N/m; infinite where none can move
  using Join = std::function<void(std::int64_t a, std::int64_t b)>;
  virtual void for_springs(
      const Join& join) const = 0;  ///< the two places of every spring that is there

  const StaticProblem& problem() const { return problem_; }
  std::size_t numbers() const override { return problem_.grid.numbers(); }
  int threads() const override { return problem_.grid.threads; }

 private:
  const StaticProblem& problem_;
};

}  // namespace hyperlattice::statics
