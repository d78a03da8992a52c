// Lack of memory is a failure of the outside, whatever the code that met it made of it: a refused
// option, a failed law, an exception where none may be.
#pragma once

#include <string>

namespace hyperlattice {

/// From now on memory_ran_out() knows, and an exception for lack of memory that nothing can catch
/// ends the program with exit code 4 and a sentence.
void watch_memory() noexcept;

/// For a handler of std::terminate: whether the program ends because it lacks memory.
bool ends_for_memory() noexcept;

/// Whether a request for memory was refused since then, or since it was forgotten.
bool memory_ran_out() noexcept;
void forget_lack_of_memory() noexcept;

/// "not enough memory: the limit on the address space (ulimit -v) is 1 GB, 990 MB of it in use".
std::string lack_of_memory();

}  // namespace hyperlattice
