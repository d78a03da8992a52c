// The gate: the numbers that decide whether a library may share objects with this program, read
// from its file before any of its code runs.
#pragma once

#include <hyperlattice/boundary.hpp>

#include <filesystem>
#include <stdexcept>
#include <string>

namespace hyperlattice {

/// Why a library is not accepted: a sentence that follows the file's name and a colon.
class Refusal : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The numbers in the name of Gate<...>::marker, in its order (boundary.hpp).
struct GateNumbers {
  unsigned interface_version = 0, compiler_abi = 0, library_abi = 0, eigen_alignment = 0;
  unsigned boundary = 0;  ///< of the layout of all that crosses
};

/// Those that this program was compiled with.
GateNumbers own_gate();

/// Those that a library was compiled with. Reads the file, runs nothing; Refusal if it is no shared
/// library of this machine or no plugin.
GateNumbers read_gate(const std::filesystem::path& library);

/// Every number in which a library differs, and what to do about it; empty if none.
std::string gate_mismatch(const GateNumbers& library, const GateNumbers& own);

}  // namespace hyperlattice
