// The linear system of a body: its tangent K, N/m, and a preconditioner. Newton's method and
// conjugate gradients use a lattice only by this interface.
#pragma once

#include <equilibrium/numerics.hpp>

#include <numerics/linear_operator.hpp>

#include <hyperlattice/statics.hpp>

#include <functional>
#include <span>

namespace hyperlattice::equilibrium {

class System : public numerics::LinearOperator, public numerics::Preconditioner {
 public:
  explicit System(const StaticProblem& problem) : problem_(problem) {}

  /// Computes the tangents at a displacement, m. Returns the stored energy, J, and in `force` the
  /// forces of the springs, N.
  virtual double linearise(const Field& displacement, Field& force) = 0;
  // multiply() gives 0 for components that cannot move, and mask() sets these to 0.
  /// Makes the preconditioner, apply(), for the present tangents.
  virtual void prepare() = 0;
  /// Returns what the preconditioner was made from, for a checkpoint; empty if prepare() depends on
  /// the present tangents alone. Valid until the next prepare().
  virtual std::span<const double> made_from() const { return {}; }
  /// Makes the preconditioner from what made_from() returned, before the first linearise(). Throws
  /// std::runtime_error if that is of another body.
  virtual void make_again(std::span<const double>) {}
  /// Returns the number of iterations after which conjugate gradients give up.
  virtual int most_iterations() const { return 1000; }
  /// Returns the largest tangent of a spring, N/m.
  virtual double stiffest() const = 0;
  /// Returns the least stiffness of a height, N/m; infinite if no height can move.
  virtual double softest_height() const = 0;
  using Join = std::function<void(std::int64_t a, std::int64_t b)>;
  /// Calls join(a, b) with the two places of every spring that is not broken.
  virtual void for_springs(const Join& join) const = 0;

  const StaticProblem& problem() const { return problem_; }
  std::size_t numbers() const override { return problem_.grid.numbers(); }
  int threads() const override { return problem_.grid.threads; }

 private:
  const StaticProblem& problem_;
};

}  // namespace hyperlattice::equilibrium
