// Files that a command is told to read. Every reader of input comes this way.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace hyperlattice {

constexpr std::uint64_t largest_input = std::uint64_t{4} << 30;  ///< bytes

/// Why a file is not read as input: it is absent, no regular file (a device or a pipe may never
/// end), or larger than largest_input. Empty: none.
std::string input_file_fault(const std::filesystem::path& file);

/// The whole file. InputError at `pointer` if input_file_fault has one: "expected <what>; there is
/// no such file". OutsideError if it cannot be read.
std::string read_input_file(const std::filesystem::path& file, const std::string& pointer,
                            const std::string& what);

}  // namespace hyperlattice
