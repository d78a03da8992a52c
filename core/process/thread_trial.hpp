// Threads that the system refuses: the error, and a trial of the threads that OpenMP will start.
#pragma once

#include <base/errors.hpp>

#include <system_error>

namespace hyperlattice {

/// Returns the error for `asked` threads of which the system starts only `started`; both numbers
/// include the calling thread.
OutsideError refused_threads(std::size_t started, std::size_t asked, const std::error_code& why);

/// Starts and ends as many threads as OpenMP will start, with the same stack size. Throws
/// OutsideError if the system refuses one; OpenMP itself would end the program with exit code 1.
void try_openmp_threads(int threads);

}  // namespace hyperlattice
