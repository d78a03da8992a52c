// files.csv: the list of the files in a folder of results that the run wrote. Each line is
// "bytes,hash,name"; the last line of a name counts. A line without bytes and hash says that the
// run was about to write the file; an interrupted run leaves such lines.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace hyperlattice {

inline constexpr const char* own_files_list = "files.csv";

/// One file of the list.
struct OwnFile {
  std::uint64_t bytes = 0;
  std::string hash;  ///< hash_of_file(); empty: the content is not known
};

/// Files by their name relative to the folder. Each name leads to a place below the folder.
using OwnFiles = std::map<std::string, OwnFile, std::less<>>;

/// Reads the list in the folder; nothing if there is no list. Throws OutsideError if the list
/// cannot be read.
std::optional<OwnFiles> read_own_files(const std::filesystem::path& directory);

/// Reads the text of a list. Skips malformed lines.
OwnFiles parse_own_files(std::string_view text);

/// Returns one line of the list.
std::string own_file_line(std::string_view name, const OwnFile& file);

/// Returns whether a run may give this name to a file in its folder: relative, without ".." and
/// control characters.
bool is_own_name(std::string_view name);

}  // namespace hyperlattice
