// The three streams that a program counts on.
#pragma once

namespace hyperlattice {

/// Opens /dev/null as standard input, output or error where the program was started without it:
/// else the next file that is opened would take its number, and what is printed would go there.
/// What is printed to a standard output that was missing fails; messages to a standard error are
/// lost.
void open_missing_streams() noexcept;

}  // namespace hyperlattice
