// Reads files of a folder of results, which may come from anyone: reads only regular files inside
// the folder and follows no link.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace hyperlattice {

/// Largest size of a file of each kind, bytes.
inline constexpr std::uint64_t largest_json = std::uint64_t{64} << 20,
                               largest_table = std::uint64_t{1} << 30,
                               largest_picture = std::uint64_t{32} << 20;

/// The result of read_folder_file().
struct FolderFile {
  std::string text;  ///< at most the requested number of bytes
  /// why the file was not read: "a link", "a folder, device or pipe", ...; empty: it was read
  std::string refusal;
};

/// Reads a file by its name relative to the folder; a name that leads out of the folder is refused.
/// Returns nothing if the file does not exist. If the file is larger than `most` bytes, reads the
/// first `most` bytes if `head`, and otherwise refuses it. Throws OutsideError if the system fails.
std::optional<FolderFile> read_folder_file(const std::filesystem::path& folder,
                                           const std::filesystem::path& name, std::uint64_t most,
                                           bool head = false);

/// Returns whether the path exists; a link counts, wherever it leads.
bool is_there(const std::filesystem::path& path);

/// Returns whether the folder has a regular file of that name.
bool has_folder_file(const std::filesystem::path& folder, const std::filesystem::path& name);

}  // namespace hyperlattice
