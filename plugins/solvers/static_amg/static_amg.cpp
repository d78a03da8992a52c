// A state of rest of a listed lattice, as solvers.static finds it, with algebraic multigrid: for lists that are too large for its factorisations.
#include "amg_system.hpp"
#include "rest_solver.hpp"

#include <stdexcept>

namespace hyperlattice {

class StaticAmg {
 public:
  struct Options : statics::RestOptions {
    double strong_threshold = 0.9;
  };

  static Schema<Options> schema() {
    return statics::rest_schema<Options>("solvers.static_amg",
                                         "A state of rest of a large listed lattice, by Newton's method and algebraic multigrid")
        .equation(
            "F_springs(u) + F_loads = 0;  K(u) du = F, K the exact tangent, by conjugate gradients with a V-cycle of algebraic multigrid as "
            "preconditioner: BoomerAMG of hypre, and on the first level a smoother that takes the numbers of a particle together")
        .restrictions(HYPERLATTICE_REST_RESTRICTIONS
                      " It takes listed lattices only, as lattices.random and lattices.points make them. It is built only "
                      "where hypre is (Debian: libhypre-dev).")
        .add<&Options::strong_threshold>("strong_threshold", "",
                                         "of multigrid: two numbers are strongly coupled if their entry of the tangent is above this share of the "
                                         "largest in the row; more is less memory, time and convergence of an iteration")
        .at_least(0)
        .below(1)
        .fallback("0.9");
  }

  explicit StaticAmg(const Options& options) : o_(options) {}

  SolverPlan plan(const SolverFacts& facts) const {
    if (!facts.listed) throw std::runtime_error("a listed lattice; of structured ones solvers.static finds the rest, by geometric multigrid");
    SolverPlan plan = statics::plan_of_load_steps(facts, o_);
    plan.bytes_per_site = 9000;
    return plan;
  }

  void run(const SolverFacts& facts, SolverHost& host) const {
    if (!host.observe()) return;
    const StaticProblem* problem = host.statics();
    if (problem == nullptr) return;
    statics::AmgSystem system(*problem, o_.strong_threshold);
    statics::bring_to_rest(system, facts, host, o_);
  }

 private:
  Options o_;
};

}  // namespace hyperlattice

HYPERLATTICE_PLUGIN("1.0") { plugin.add<hyperlattice::StaticAmg>(); }
