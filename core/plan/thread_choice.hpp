// The threads of a run by the user's choice and by the environment.
#pragma once

#include <plan/threads.hpp>

namespace hyperlattice {

inline constexpr int most_threads = 4096;  ///< that a user may ask for

/// Returns the threads of a run. `number`: that the user asked for, 1 to most_threads; 0: none.
/// Then OMP_NUM_THREADS counts, and without it every processor that the process may use, of which
/// each of `node_ranks` on this machine takes its share. Throws InputError if OMP_NUM_THREADS is no
/// such number.
Threads chosen_threads(int number, int node_ranks = 1);

}  // namespace hyperlattice
