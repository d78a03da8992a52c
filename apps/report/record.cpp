#include <base/csv.hpp>
#include <base/folder_file.hpp>
#include <report/record.hpp>
#include <run/checkpoint.hpp>
#include <run/failing_motion.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>

namespace hyperlattice::report {

namespace fs = std::filesystem;

namespace {

/// Reads a table; empty if the file does not exist.
Columns read_table(const fs::path& name, RunRecord& run, Faults& faults) {
  const auto text = read_text(run.folder, name, largest_table, faults);
  if (!text) return {};
  Columns columns = read_columns(run.folder / name, *text, faults);
  if (columns.is_cut)
    run.notes.push_back(
        fmt::format("{} ends within a line, which is left out.", name.generic_string()));
  return columns;
}

void check_history(const RunRecord& run, Faults& faults) {
  if (run.history.names.empty()) return;
  std::vector<std::string> missing;
  for (const char* name : {"time", "step", "kinetic", "stored", "dissipated", "injected",
                           "relative_error", "broken_open", "broken_closed"})
    if (run.history.find(name) == nullptr) missing.emplace_back(name);
  if (!missing.empty())
    faults.add((run.folder / "history.csv").string(), "",
               fmt::format("the columns of a history; it has no {}", fmt::join(missing, ", ")));
}

/// Returns the names of the probes in the run's scene, since other tables in the folder belong to
/// an earlier run. Without a scene, returns the names of all tables.
std::vector<std::string> probe_names(const RunRecord& run) {
  std::vector<std::string> names;
  if (run.scene.is_object() && run.scene.contains("pipeline")) {
    for (const Json& stage : run.scene["pipeline"])
      if (word_in(stage, "type").starts_with("probes.")) names.push_back(word_in(stage, "name"));
  } else {
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(run.folder / "probes", none))
      if (entry.path().extension() == ".csv") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

void read_probes(RunRecord& run, Faults& faults) {
  for (const std::string& name : probe_names(run)) {
    const fs::path file = fs::path("probes") / (name + ".csv");
    Columns table = read_table(file, run, faults);
    if (!table.names.empty() && table.names.front() != "time")
      faults.add((run.folder / file).string(), "\"" + table.names.front() + "\"",
                 "a first column \"time\"");
    if (!table.names.empty()) run.probes.push_back({name, std::move(table)});
  }
}

/// Returns the time, s, at which the first spring broke. Reads only the first two lines of the log,
/// which may have millions.
std::optional<double> read_first_break(const RunRecord& run) {
  constexpr std::uint64_t enough = 4096;
  if (run.summary.is_object() && run.summary.value("breakable", Json()) == false)
    return std::nullopt;  // the log belongs to an earlier run
  const auto file = read_folder_file(run.folder, "failures.csv", enough, true);
  if (!file || std::count(file->text.begin(), file->text.end(), '\n') < 2) return std::nullopt;
  const auto second = file->text.find('\n', file->text.find('\n') + 1);
  const CsvTable table = parse_csv(std::string_view(file->text).substr(0, second));
  const auto column = table.column("time");
  return column && !table.rows.empty() ? csv_number(table.rows.front()[*column]) : std::nullopt;
}

const Json* find(const Json& json, const std::string& pointer) {
  const Json::json_pointer place(pointer);
  return json.is_object() && json.contains(place) ? &json.at(place) : nullptr;
}

}  // namespace

std::string RunRecord::title() const {
  for (const Json* source : {&summary, &scene})
    if (std::string title = word_in(*source, "title"); !title.empty()) return title;
  return label;
}

std::string RunRecord::status() const { return summary.is_null() ? "unfinished" : word("/status"); }

std::optional<double> RunRecord::number(const std::string& pointer) const {
  const Json* found = find(summary, pointer);
  return found != nullptr && found->is_number() ? std::optional<double>(found->get<double>())
                                                : std::nullopt;
}

std::string RunRecord::word(const std::string& pointer) const {
  const Json* found = find(summary, pointer);
  return found != nullptr && found->is_string() ? found->get<std::string>() : "";
}

bool is_run(const fs::path& folder) {
  return has_folder_file(folder, "summary.json") || has_folder_file(folder, "history.csv");
}

std::optional<std::string> read_text(const fs::path& folder, const fs::path& name,
                                     std::uint64_t most, Faults& faults) {
  auto file = read_folder_file(folder, name, most);
  if (!file) return std::nullopt;
  if (!file->refusal.empty()) {
    faults.add((folder / name).string(), file->refusal,
               fmt::format("a regular file of at most {} MB", most >> 20));
    return std::nullopt;
  }
  return std::move(file->text);
}

Json read_json_object(const fs::path& folder, const fs::path& name, Faults& faults) {
  const auto text = read_text(folder, name, largest_json, faults);
  if (!text) return nullptr;
  const fs::path file = folder / name;
  Json json;
  Faults own;
  const bool is_json = parse_json(*text, json, own);
  for (const Fault& fault : own.all())
    faults.add(file.string() + " " + fault.pointer, fault.value, fault.expected);
  if (is_json && !json.is_object()) faults.add(file.string(), shown(json), "an object");
  return is_json && json.is_object() ? json : Json(nullptr);
}

RunRecord read_run(const fs::path& folder, Faults& faults) {
  RunRecord run;
  run.folder = folder;
  run.summary = read_json_object(folder, "summary.json", faults);
  if (!run.summary.is_null() && run.word("/status").empty())
    faults.add((folder / "summary.json").string() + " /status", "",
               "\"done\", \"failed\" or \"interrupted\"");
  run.scene = read_json_object(folder, "scene.resolved.json", faults);
  if (run.scene.is_null())
    run.notes.emplace_back("scene.resolved.json is not there: what the scene was is not known.");
  run.history = read_table("history.csv", run, faults);
  check_history(run, faults);
  if (run.history.rows() == 0)
    run.notes.emplace_back(
        "history.csv has no record yet: nothing can be said of energies over time.");
  read_probes(run, faults);
  run.first_break = read_first_break(run);
  run.has_failing_motion = has_folder_file(folder, failing_motion_file);
  run.has_checkpoint = has_folder_file(folder, checkpoint_file);
  run.pictures = find_pictures(folder, run.scene, run.number("/end_time"), run.notes);
  return run;
}

}  // namespace hyperlattice::report
