// The choice of the linear system and its preconditioner for a body.
#pragma once

#include <equilibrium/system.hpp>

#include <memory>
#include <string_view>

namespace hyperlattice::equilibrium {

/// The preconditioner of listed lattices; structured ones have geometric multigrid.
enum class Preconditioner : std::uint32_t { automatic, whole, incomplete, multigrid };
inline constexpr std::string_view preconditioner_names[] = {"automatic", "whole", "incomplete",
                                                            "multigrid"};

/// Returns the system of a body, which must outlive it.
std::unique_ptr<System> make_system(const StaticProblem& problem, Preconditioner preconditioner);

}  // namespace hyperlattice::equilibrium
