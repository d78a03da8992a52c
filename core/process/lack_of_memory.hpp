// Detects lack of memory. It is always an OutsideError, even if the code that met it reported
// something else: a refused option, a failed law, an exception where none is allowed.
#pragma once

#include <string>

namespace hyperlattice {

/// Starts the detection for memory_ran_out(). From then on, an uncaught exception for lack of
/// memory ends the program with exit code 4 and a message.
void watch_memory() noexcept;

/// Returns, in a handler of std::terminate, whether the program ends for lack of memory.
bool ends_for_memory() noexcept;

/// Returns whether a request for memory was refused since watch_memory() or the last
/// forget_lack_of_memory().
bool memory_ran_out() noexcept;
/// Resets memory_ran_out() to false.
void forget_lack_of_memory() noexcept;

/// Returns a message: "not enough memory: the limit on the address space (ulimit -v) is 1 GB, 990
/// MB of it in use".
std::string lack_of_memory();

}  // namespace hyperlattice
