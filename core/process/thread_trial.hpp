// Threads that the system refuses: how that is told, and a trial of those that OpenMP will start.
#pragma once

#include <base/errors.hpp>

#include <system_error>

namespace hyperlattice {

/// The error for `asked` threads of which the system starts only `started`. Both numbers include
/// the thread that asks.
OutsideError refused_threads(std::size_t started, std::size_t asked, const std::error_code& why);

/// Starts as many threads as OpenMP is about to, with stacks as large, and lets them end. OpenMP
/// itself ends the program with exit code 1 where the system refuses one; this throws OutsideError.
void try_openmp_threads(int threads);

}  // namespace hyperlattice
