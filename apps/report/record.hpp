// The files of a run's folder, read for a report.
#pragma once

#include <report/columns.hpp>
#include <report/pictures.hpp>
#include <scene/json.hpp>

#include <nlohmann/json.hpp>

#include <optional>

namespace hyperlattice::report {

/// The table of a probe.
struct Probe {
  std::string name;
  Columns table;
};

/// The content of a run's folder.
struct RunRecord {
  std::filesystem::path folder;
  std::string label;          ///< unique name of the run in the report
  Json summary;               ///< null if the run goes on or was killed
  Json scene;                 ///< the resolved scene; null if the folder does not have it
  Columns history;            ///< no columns if the run ended before its first record
  std::vector<Probe> probes;  ///< in the order of their names
  std::vector<PictureSeries> pictures;
  std::optional<double> first_break;  ///< time at which the first spring broke, s
  bool has_failing_motion = false;
  bool has_checkpoint = false;
  std::vector<std::string> notes;  ///< sentences about data that the report leaves out

  std::string title() const;  ///< title of the scene; the label if it has none
  /// Returns "done", "failed", "interrupted", or "unfinished" without a summary.
  std::string status() const;
  /// Returns a number of the summary; nothing if it is missing or not a number.
  std::optional<double> number(const std::string& pointer) const;
  std::string word(const std::string& pointer) const;  ///< a text of the summary, or empty
};

/// Returns whether the folder contains a run, finished or not.
bool is_run(const std::filesystem::path& folder);

/// Reads a run. Adds a fault for each file with invalid content. Throws OutsideError if a file
/// cannot be read.
RunRecord read_run(const std::filesystem::path& folder, Faults& faults);

/// Returns the text of a file in the folder; nothing if the file does not exist. A file that is not
/// a regular file or is larger than `most` bytes is a fault.
std::optional<std::string> read_text(const std::filesystem::path& folder,
                                     const std::filesystem::path& name, std::uint64_t most,
                                     Faults& faults);

/// Returns the content of a JSON file; null if the file does not exist. Truncated JSON, or a value
/// that is not an object, is a fault.
Json read_json_object(const std::filesystem::path& folder, const std::filesystem::path& name,
                      Faults& faults);

}  // namespace hyperlattice::report
