// Common parts of solvers that search a state of rest: unsupported bodies, and the end time.
#pragma once

#include <hyperlattice/files.hpp>
#include <hyperlattice/solver.hpp>

#include <algorithm>
#include <optional>
#include <stdexcept>

namespace hyperlattice {

/// Returns a plan for a state of rest at `end_time`, s; by default when the last load stops
/// changing. Throws std::runtime_error if the core has no statics for the body, and for an end
/// before the start.
inline SolverPlan plan_of_rest(const SolverFacts& facts, std::optional<double> end_time) {
  if (facts.answering)
    throw std::runtime_error(
        "loads that do not answer to the motion; with such loads a body comes to rest by steps in "
        "time with damping");
  SolverPlan plan;
  plan.at_rest = true;
  plan.end_time = end_time.value_or(
      facts.corners.empty() ? facts.start_time : std::max(facts.start_time, facts.corners.back()));
  if (plan.end_time < facts.start_time)
    throw std::runtime_error("end_time of at least " + short_number(facts.start_time) +
                             " s, where the stage starts");
  return plan;
}

}  // namespace hyperlattice
