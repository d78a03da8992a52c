// A state of rest at given loads, by Newton's method with the exact tangent; each step of it by
// conjugate gradients, only as far as the tangent is true.
#pragma once

#include "system.hpp"

#include <numerics/conjugate_gradients.hpp>

#include <hyperlattice/solver.hpp>

#include <string>

namespace hyperlattice::statics {

struct Limits {
  double tolerance = 1e-6;  ///< residual
  int newton = 30;          ///< steps, before the load step is given up
  bool stable = true;       ///< states of rest must be stable ones
};

/// What became of a search.
struct Outcome {
  bool at_rest = false;
  bool hopeless = false;  ///< if not, whether a smaller step of the load could not do better: the
                          ///< state before has no stiffness
  std::string why{};      ///< if not, a sentence
  bool buckles = false;   ///< if not, whether there is a state of rest, but no stable one
  bool rigid = false;  ///< if not, whether it moves as a rigid body or piece, which `why` tells of
  Field direction{};   ///< if not, how the body moves where it has no stiffness; may be empty
};

class Newton {
 public:
  Newton(System& system, const SolverHost& host, const Limits& limits);

  /// From the displacements of a state of rest to those at a share of the load; by whole steps
  /// first, and with a line search if they fail.
  Outcome solve_load_step(double share, Field& displacement);
  const RestReport& report() const { return report_; }
  bool stopped() const { return stopped_; }  ///< the host asked to

 private:
  enum class StepResult {
    converged,
    reduced_residual,
    cancelled,
    linear_solver_failed,
    indefinite_tangent,
    no_progress,
    not_finite
  };
  Outcome iterate(double share, Field& displacement);
  StepResult step(const Field& change_of_held, Field& u);
  bool evaluate_residual(const Field& u, const Field& moved, double part = 1);
  bool step_along(const Field& moved, Field& u);
  Outcome no_stiffness(const Field& u, bool hopeless, const char* why,
                       const Field& direction) const;
  Outcome explain_failure(const Field& last, const Field& u);
  std::string linear_solver_failure() const;
  bool may_wrinkle(const Field& u) const;
  Outcome check_stability(const Field& u);

  System& system_;
  const StaticProblem& problem_;
  const SolverHost& host_;
  Limits limits_;
  numerics::ConjugateGradients gradients_;
  bool careful_ = false;   ///< steps that go too far are shortened
  bool prepared_ = false;  ///< tangents and preconditioner are those of the state that the next
                           ///< search starts from
  Field external_, force_, trial_, rest_, right_, held_part_;
  double scale_ = 0;
  bool stopped_ = false;
  RestReport report_;
};

}  // namespace hyperlattice::statics
