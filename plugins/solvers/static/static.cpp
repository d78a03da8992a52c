// A state of rest, found as such: Newton's method on the balance of forces, with steps of the load that become shorter where it does not converge.
#include "factorised_system.hpp"
#include "grid_system.hpp"
#include "rest_solver.hpp"

namespace hyperlattice {

constexpr std::string_view factorisation_names[] = {"automatic", "whole", "incomplete"};

class Static {
 public:
  struct Options : statics::RestOptions {
    statics::Factorisation factorisation = statics::Factorisation::automatic;
  };

  static Schema<Options> schema() {
    return statics::rest_schema<Options>("solvers.static", "A state of rest by Newton's method, geometrically nonlinear")
        .equation(
            "F_springs(u) + F_loads = 0;  K(u) du = F, K the exact tangent, by conjugate gradients with a multigrid V-cycle as preconditioner, of "
            "listed lattices with a sparse factorisation")
        .restrictions(HYPERLATTICE_REST_RESTRICTIONS)
        .add<&Options::factorisation>(
            "factorisation", "",
            "of listed lattices: of the whole tangent, or an incomplete one that takes far less memory and more iterations; "
            "automatic: whole up to 4000 numbers")
        .choices(factorisation_names)
        .fallback("\"automatic\"");
  }

  explicit Static(const Options& options) : o_(options) {}

  SolverPlan plan(const SolverFacts& facts) const {
    SolverPlan plan = statics::plan_of_load_steps(facts, o_);
    plan.bytes_per_site = facts.listed ? 8500 : 1300;
    return plan;
  }

  void run(const SolverFacts& facts, SolverHost& host) const {
    if (!host.observe()) return;
    const StaticProblem* problem = host.statics();
    if (problem != nullptr) statics::bring_to_rest(*system_of(*problem), facts, host, o_);
  }

 private:
  std::unique_ptr<statics::System> system_of(const StaticProblem& problem) const {
    if (problem.grid.listed) return std::make_unique<statics::FactorisedSystem>(problem, o_.factorisation);
    return std::make_unique<statics::GridSystem>(problem);
  }

  Options o_;
};

}  // namespace hyperlattice

HYPERLATTICE_PLUGIN("1.0") { plugin.add<hyperlattice::Static>(); }
