// The file that describes a machine for `hyperlattice plan --ranks N --machine FILE`.
#pragma once

#include <plan/distribution.hpp>

#include <filesystem>

namespace hyperlattice {

/// Reads a machine; the default one if `file` is empty. Throws InputError with all its faults.
Machine read_machine(const std::filesystem::path& file);

}  // namespace hyperlattice
