// Output files that a user names.
#pragma once

#include <filesystem>
#include <string_view>

namespace hyperlattice {

/// Writes a file. If the name is free or belongs to a regular file, the new file appears at once
/// and complete. If it belongs to a device, a pipe or a link, the bytes are written into the
/// target, which is not replaced. Throws OutsideError with the system's reason.
void write_named_file(const std::filesystem::path& file, std::string_view bytes);

}  // namespace hyperlattice
