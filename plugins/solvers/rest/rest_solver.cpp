#include "rest_solver.hpp"

#include "failure.hpp"

#include <stdexcept>

namespace hyperlattice::statics {

SolverPlan plan_of_load_steps(const SolverFacts& facts, const RestOptions& options) {
  SolverPlan plan = plan_of_rest(facts, options.end_time);
  plan.steps = static_cast<std::uint64_t>(options.load_steps);
  plan.sweeps_per_step = 150;
  return plan;
}

void bring_to_rest(System& system, const SolverFacts& facts, SolverHost& host, const RestOptions& options) {
  const StaticProblem& problem = system.problem();
  Newton newton(system, host, {.tolerance = options.tolerance, .stable = options.stability.value_or(!facts.listed)});
  Field u(problem.state, problem.state + problem.grid.numbers());
  const double whole = 1 / std::floor(options.load_steps), shortest = whole * std::exp2(-options.most_cutbacks);
  double share = 0, length = whole;
  while (share < 1) {
    constexpr double nearly = 1e-9;
    const double next = share + length > 1 - nearly ? 1 : share + length;
    const Found found = newton.find(next, u);
    if (newton.stopped()) return;
    if (found.at_rest) {
      share = next;
      length = std::min(whole, 2 * length);
      if (!host.accept(share, u.data()) || !host.report(newton.report()) || !host.observe()) return;
    } else {
      length /= 2;
      if (!found.hopeless && length >= 0.99 * shortest) continue;
      if (!found.direction.empty() && !host.show_motion(found.direction.data())) return;
      const double start = facts.start_time, end = plan_of_load_steps(facts, options).end_time, time = start + share * (end - start);
      throw std::runtime_error(failure_text(problem, share, time, found));
    }
  }
}

}  // namespace hyperlattice::statics
