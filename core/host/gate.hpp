// The gate: the numbers that decide whether a library and this program can share objects. They are
// read from the library's file before any of its code runs.
#pragma once

#include <hyperlattice/boundary.hpp>

#include <filesystem>
#include <stdexcept>
#include <string>

namespace hyperlattice {

/// The reason for refusing a library: a sentence that follows the file's name and a colon.
class Refusal : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The numbers in the name of Gate<...>::marker, in its order (boundary.hpp).
struct GateNumbers {
  unsigned interface_version = 0, compiler_abi = 0, library_abi = 0, eigen_alignment = 0;
  unsigned boundary = 0;  ///< hash of the layout of all types that cross the boundary
};

/// Returns the numbers of this program.
GateNumbers own_gate();

/// Returns the numbers of a library. Reads the file and runs no code of it. Throws Refusal if the
/// file is no shared library for this machine or no plugin.
GateNumbers read_gate(const std::filesystem::path& library);

/// Returns a sentence with each number that differs and its remedy; empty if the library fits.
std::string gate_mismatch(const GateNumbers& library, const GateNumbers& own);

}  // namespace hyperlattice
