// Checks files that a command writes under a user's name or a default one: they must not replace a
// result, an input, or a file of another kind.
#pragma once

#include <base/errors.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace hyperlattice {

struct OutputFile {
  std::string option;  ///< the option that names it: "--out"
  std::filesystem::path file;
  std::vector<std::string> endings;  ///< of its kind of file: ".html", ".htm"
  bool is_default = false;           ///< the user did not name it
};

/// Adds a fault if the name belongs to a folder, a link to nothing or to itself, one of the
/// `inputs`, a file that a run or study left (by the lists in its folder and in those above), or a
/// file with content and another ending. In a folder where a run is writing, only report.html is
/// allowed. Devices, pipes and links to writable files are allowed, but not under a default name.
void check_output_file(const OutputFile& output, const std::vector<std::filesystem::path>& inputs,
                       Faults& faults);

}  // namespace hyperlattice
