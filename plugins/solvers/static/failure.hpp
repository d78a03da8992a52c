// Explains in a sentence why the solver found no state of rest.
#pragma once

#include <equilibrium/newton.hpp>

namespace hyperlattice::equilibrium {

/// Returns the error message. The last state of rest was at the fraction `share` of the load, at
/// `time`, s; `found` is the outcome of the search that failed.
std::string failure_text(const StaticProblem& problem, double share, double time,
                         const Outcome& found);

}  // namespace hyperlattice::equilibrium
