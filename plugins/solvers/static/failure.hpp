// Explains in a sentence why the solver found no state of rest.
#pragma once

#include <equilibrium/newton.hpp>

namespace hyperlattice::equilibrium {

/// The last state of rest.
struct LastRest {
  double share = 0, time = 0;  ///< fraction of the load, and s
  std::uint64_t broke = 0;     ///< springs that broke in it
};

/// Returns the error message. `found`: the outcome of the search that failed.
std::string failure_text(const StaticProblem& problem, const LastRest& last, const Outcome& found);

}  // namespace hyperlattice::equilibrium
