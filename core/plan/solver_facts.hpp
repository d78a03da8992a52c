// The facts that a solver gets before its stage.
#pragma once

#include <model/model.hpp>

#include <hyperlattice/solver.hpp>

namespace hyperlattice {

/// Returns the facts of a stage that begins at `start_time`, s.
SolverFacts solver_facts(const Model& model, double start_time);

}  // namespace hyperlattice
