// What a run left in its folder, read for a report.
#pragma once

#include <report/columns.hpp>
#include <report/pictures.hpp>
#include <scene/json.hpp>

#include <nlohmann/json.hpp>

#include <optional>

namespace hyperlattice::report {

struct Probe {
  std::string name;
  Columns table;
};

struct RunRecord {
  std::filesystem::path folder;
  std::string label;          ///< tells it from the other runs of the report
  Json summary;               ///< null: the run goes on, or was killed
  Json scene;                 ///< as resolved; null if the folder does not hold it
  Columns history;            ///< no columns if the run ended before its first record
  std::vector<Probe> probes;  ///< by name
  std::vector<PictureSeries> pictures;
  std::optional<double> first_break;  ///< s
  bool has_failing_motion = false;
  bool has_checkpoint = false;
  std::vector<std::string> notes;  ///< sentences on what is left out

  std::string title() const;  ///< of the scene; of a scene without one, the label
  std::string status()
      const;  ///< "done", "failed", "interrupted", or "unfinished" without a summary
  std::optional<double> number(const std::string& pointer)
      const;  ///< of the summary; nothing if it is not there, or no number
  std::string word(const std::string& pointer) const;  ///< likewise; or empty
};

/// Whether the folder holds a run, finished or not.
bool is_run(const std::filesystem::path& folder);

/// Adds a fault for each file that cannot be understood. OutsideError if one cannot be read.
RunRecord read_run(const std::filesystem::path& folder, Faults& faults);

/// The text of a file of the folder; nothing if there is no such file, or after a fault: it is no
/// regular file, or larger than `most` bytes.
std::optional<std::string> read_text(const std::filesystem::path& folder,
                                     const std::filesystem::path& name, std::uint64_t most,
                                     Faults& faults);

/// A JSON file's content; a fault if it is not whole or no object. Null if there is no such file.
Json read_json_object(const std::filesystem::path& folder, const std::filesystem::path& name,
                      Faults& faults);

}  // namespace hyperlattice::report
