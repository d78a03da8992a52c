#include <equilibrium/aggregated_system.hpp>
#include <equilibrium/factorised_system.hpp>
#include <equilibrium/grid_system.hpp>
#include <equilibrium/systems.hpp>

namespace hyperlattice::equilibrium {

std::unique_ptr<System> make_system(const StaticProblem& problem, Preconditioner preconditioner) {
  if (!problem.grid.listed) return std::make_unique<GridSystem>(problem);
  constexpr std::int64_t few =
      4000;  // unknowns up to which a complete factorisation is as fast as multigrid
  const bool small = static_cast<std::int64_t>(problem.grid.numbers()) <= few;
  if (preconditioner == Preconditioner::multigrid ||
      (preconditioner == Preconditioner::automatic && !small))
    return std::make_unique<AggregatedSystem>(problem);
  return std::make_unique<FactorisedSystem>(problem, preconditioner != Preconditioner::incomplete);
}

}  // namespace hyperlattice::equilibrium
