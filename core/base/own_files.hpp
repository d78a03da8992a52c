// files.csv: the list of the files in a folder of results that are the run's own. Each line is
// "bytes,hash,name"; of a name's lines the last one counts. A line without bytes and hash says that
// the run was about to write the file; a run that was cut off leaves such lines.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace hyperlattice {

inline constexpr const char* own_files_list = "files.csv";

struct OwnFile {
  std::uint64_t bytes = 0;
  std::string hash;  ///< hash_of_file(); empty: what the file holds is not known
};

/// The files by their name, relative to the folder. Such a name leads neither out of the folder nor
/// back to it.
using OwnFiles = std::map<std::string, OwnFile, std::less<>>;

/// The run's own files, as the list in the folder names them; nothing if there is no list.
/// OutsideError if it cannot be read.
std::optional<OwnFiles> read_own_files(const std::filesystem::path& directory);

/// The same from the list's text. Lines that say nothing are passed over.
OwnFiles parse_own_files(std::string_view text);

/// One line of the list.
std::string own_file_line(std::string_view name, const OwnFile& file);

/// Whether a name is one that a run may give to a file in its folder: relative, without ".." and
/// control characters.
bool is_own_name(std::string_view name);

}  // namespace hyperlattice
