// Why there is no state of rest, in a sentence.
#pragma once

#include "newton.hpp"

namespace hyperlattice::statics {

/// `share` of the load, at `time`, s, was the last with a state of rest.
std::string failure_text(const StaticProblem& problem, double share, double time,
                         const Outcome& found);

}  // namespace hyperlattice::statics
