// Files of a folder of results, which anyone may have filled: only regular files that stand in it
// are read, and no link leads out of it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace hyperlattice {

inline constexpr std::uint64_t largest_json = std::uint64_t{64} << 20,
                               largest_table = std::uint64_t{1} << 30,
                               largest_picture = std::uint64_t{32} << 20;  ///< bytes

struct FolderFile {
  std::string text;     ///< at most as much as was asked for
  std::string refusal;  ///< why it is not read: "a link", "a device, pipe or folder", ...; empty:
                        ///< it was read
};

/// Reads a file by its name relative to the folder, which must not lead out of it. Nothing if there
/// is no such file. Of a file larger than `most`, the first `most` bytes if `head`; otherwise it is
/// refused. OutsideError if the system fails.
std::optional<FolderFile> read_folder_file(const std::filesystem::path& folder,
                                           const std::filesystem::path& name, std::uint64_t most,
                                           bool head = false);

/// Whether a regular file of that name stands in the folder.
bool has_folder_file(const std::filesystem::path& folder, const std::filesystem::path& name);

}  // namespace hyperlattice
