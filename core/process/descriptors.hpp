// The three standard streams of a program.
#pragma once

namespace hyperlattice {

/// Opens /dev/null as standard input, output or error if the program was started without it.
/// Otherwise the next opened file would get that number and receive the printed text. Printing to a
/// replaced standard output fails; messages to a replaced standard error are lost.
void open_missing_streams() noexcept;

}  // namespace hyperlattice
