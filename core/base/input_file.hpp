// Input files that a user names. All readers of input use these functions.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace hyperlattice {

constexpr std::uint64_t largest_input = std::uint64_t{4} << 30;  ///< largest input file, bytes

/// Returns why a file cannot be an input: it is absent, no regular file (reading a device or a pipe
/// may never end), or larger than largest_input. Empty: no fault.
std::string input_file_fault(const std::filesystem::path& file);

/// Returns the whole file. Throws InputError at `pointer` if input_file_fault() finds a fault:
/// "expected <what>; there is no such file". Throws OutsideError if reading fails.
std::string read_input_file(const std::filesystem::path& file, const std::string& pointer,
                            const std::string& what);

}  // namespace hyperlattice
