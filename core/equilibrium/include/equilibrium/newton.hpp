// Newton's method for a state of rest at given loads, with the exact tangent:
//   K(u) du = F(u),  u := u + du.
// Conjugate gradients solve each step, only as far as the tangent predicts the forces well.
#pragma once

#include <equilibrium/system.hpp>

#include <numerics/conjugate_gradients.hpp>

#include <hyperlattice/solver.hpp>

#include <string>

namespace hyperlattice::equilibrium {

struct Limits {
  double tolerance = 1e-6;  ///< residual of a state of rest
  int newton = 30;          ///< most Newton steps of a load step
  bool stable = true;       ///< whether states of rest must be stable
};

/// The outcome of the search for a state of rest.
struct Outcome {
  bool at_rest = false;
  // The members below have a meaning only if at_rest is false.
  bool hopeless = false;  ///< a smaller load step cannot help: the state before has no stiffness
  std::string why{};      ///< reason, a sentence
  bool buckles = false;   ///< the search came to states whose stiffness is negative
  bool rigid = false;     ///< the body or a piece moves as a rigid body, described in `why`
  Field direction{};  ///< motion without stiffness, or from the last state of rest; may be empty
};

class Newton {
 public:
  Newton(System& system, const SolverHost& host, const Limits& limits);

  /// Changes the displacements from those of a state of rest to those at the fraction `share` of
  /// the load. The first search takes full Newton steps. If it fails, others follow: in a body that
  /// tears one in which all particles are held softly, then one with a line search.
  Outcome solve_load_step(double share, Field& displacement);
  double tolerance() const { return limits_.tolerance; }
  void set_tolerance(double tolerance) { limits_.tolerance = tolerance; }
  /// Must be called before a search if the forces of the springs have changed since the last one.
  void forget_tangent() { prepared_ = false; }
  /// What a search takes over from those before it, besides displacements, tangents and
  /// preconditioner (System::made_from()).
  struct Memory {
    RestReport report;
    double scale = 0;  ///< of out-of-balance forces, N
  };
  Memory memory() const { return {report_, scale_}; }
  /// Goes on with this memory.
  void recall(const Memory& memory) {
    report_ = memory.report;
    scale_ = memory.scale;
  }
  System& system() const { return system_; }
  const RestReport& report() const { return report_; }
  bool stopped() const { return stopped_; }  ///< whether the host stopped the search

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
  bool iterate_held(double share, Field& displacement);
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
  bool careful_ = false;   ///< whether a line search shortens steps that go too far
  bool prepared_ = false;  ///< whether tangents and preconditioner belong to the state at which the
                           ///< next search starts
  Field external_, force_, trial_, rest_, right_, held_part_;
  double scale_ = 0;
  double round_off_ = 0;  ///< of forces, N
  bool stopped_ = false;
  RestReport report_;
};

}  // namespace hyperlattice::equilibrium
