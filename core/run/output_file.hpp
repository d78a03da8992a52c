// Files that a command writes because a user named them, or under a name of its own: they take the
// place of no result, no input, and nothing of another kind.
#pragma once

#include <base/errors.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace hyperlattice {

struct OutputFile {
  std::string option;  ///< that names it: "--out"
  std::filesystem::path file;
  std::vector<std::string> endings;  ///< of its kind: ".html", ".htm"
  bool is_default = false;           ///< the user did not name it
};

/// A fault if there is a folder, a link to nothing or to itself, one of the `inputs`, a file that a
/// run or study left (this goes by the lists of the file's folder and of those above), or a file
/// that holds something and has another ending. Nothing but report.html goes into a folder in which
/// a run is writing. Devices and pipes are free, and links to files that may be written; under a
/// default name they are faults.
void check_output_file(const OutputFile& output, const std::vector<std::filesystem::path>& inputs,
                       Faults& faults);

}  // namespace hyperlattice
