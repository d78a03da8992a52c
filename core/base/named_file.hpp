// Files whose names a user gave.
#pragma once

#include <filesystem>
#include <string_view>

namespace hyperlattice {

/// Writes a file: whole and in one go if its name is free or that of a regular file; into it if it
/// is a device, a pipe or a link to anything, which stays what it is. Throws OutsideError with the
/// system's reason.
void write_named_file(const std::filesystem::path& file, std::string_view bytes);

}  // namespace hyperlattice
