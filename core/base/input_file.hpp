// Files that a command is told to read.
#pragma once

#include <filesystem>
#include <string>

namespace hyperlattice {

/// The whole file. InputError at `pointer` if there is none: "expected <what>; there is no such file". OutsideError if it cannot be read.
std::string read_input_file(const std::filesystem::path& file, const std::string& pointer, const std::string& what);

}  // namespace hyperlattice
