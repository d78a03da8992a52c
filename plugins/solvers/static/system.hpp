// The tangent K of a body, and what solves K x = b roughly: all that Newton's method and conjugate gradients know of a lattice.
#pragma once

#include "fields.hpp"

#include <hyperlattice/statics.hpp>

#include <functional>

namespace hyperlattice::statics {

class System {
 public:
  explicit System(const StaticProblem& problem) : problem_(problem) {}
  virtual ~System() = default;
  System(const System&) = delete;
  System& operator=(const System&) = delete;

  /// Takes the tangents at a displacement; returns the energy stored there, J, and the forces of the springs.
  virtual double linearise(const Field& displacement, Field& force) = 0;
  /// y = K x, 0 where nothing can move.
  virtual void multiply(const double* x, double* y) const = 0;
  /// Sets to zero what cannot move.
  virtual void mask(double* x) const = 0;
  virtual void prepare() = 0;                           ///< apply(), for the present tangents
  virtual void apply(const Field& r, Field& z) = 0;     ///< z, about K^-1 r
  virtual int most_iterations() const { return 1000; }  ///< of conjugate gradients, in which they find what they can
  virtual double stiffest() const = 0;                  ///< largest tangent of a spring, N/m
  virtual double softest_height() const = 0;            ///< least stiffness of a height, N/m; infinite where none can move
  using Join = std::function<void(std::int64_t a, std::int64_t b)>;
  virtual void for_springs(const Join& join) const = 0;  ///< the two places of every spring that is there

  const StaticProblem& problem() const { return problem_; }
  std::size_t numbers() const { return problem_.grid.numbers(); }
  int threads() const { return problem_.grid.threads; }

 private:
  const StaticProblem& problem_;
};

}  // namespace hyperlattice::statics
