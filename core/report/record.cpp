#include <base/csv.hpp>
#include <base/input_file.hpp>
#include <report/record.hpp>
#include <run/checkpoint.hpp>
#include <run/failing_motion.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <fstream>

namespace hyperlattice::report {

namespace fs = std::filesystem;

namespace {

/// The table of that file, if there is one.
Columns read_table(const fs::path& file, RunRecord& run, Faults& faults) {
  if (!fs::exists(file)) return {};
  Columns columns = read_columns(file, read_input_file(file, file.string(), "a table"), faults);
  if (columns.is_cut)
    run.notes.push_back(fmt::format("{} ends within a line, which is left out.", file.lexically_relative(run.folder).generic_string()));
  return columns;
}

void check_history(const RunRecord& run, Faults& faults) {
  if (run.history.names.empty()) return;
  std::vector<std::string> missing;
  for (const char* name : {"time", "step", "kinetic", "stored", "dissipated", "injected", "relative_error", "broken_open", "broken_closed"})
    if (run.history.find(name) == nullptr) missing.emplace_back(name);
  if (!missing.empty())
    faults.add((run.folder / "history.csv").string(), "", fmt::format("the columns of a history; it has no {}", fmt::join(missing, ", ")));
}

void read_probes(RunRecord& run, Faults& faults) {
  std::error_code none;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(run.folder / "probes", none))
    if (entry.path().extension() == ".csv") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    Columns table = read_table(file, run, faults);
    if (!table.names.empty() && table.names.front() != "time")
      faults.add(file.string(), "\"" + table.names.front() + "\"", "a first column \"time\"");
    if (!table.names.empty()) run.probes.push_back({file.stem().string(), std::move(table)});
  }
}

/// When the first spring broke: of a log that may have millions of lines, only the first is read.
std::optional<double> read_first_break(const fs::path& file) {
  std::ifstream stream(file);
  std::string head, line;
  if (!std::getline(stream, head) || !std::getline(stream, line) || stream.eof()) return std::nullopt;
  const CsvTable table = parse_csv(head + '\n' + line);
  const auto column = table.column("time");
  return column ? csv_number(table.rows.front()[*column]) : std::nullopt;
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
  return found != nullptr && found->is_number() ? std::optional<double>(found->get<double>()) : std::nullopt;
}

std::string RunRecord::word(const std::string& pointer) const {
  const Json* found = find(summary, pointer);
  return found != nullptr && found->is_string() ? found->get<std::string>() : "";
}

bool is_run(const fs::path& folder) { return fs::exists(folder / "summary.json") || fs::exists(folder / "history.csv"); }

Json read_json_object(const fs::path& file, Faults& faults) {
  if (!fs::exists(file)) return nullptr;
  Json json;
  Faults own;
  const bool is_json = parse_json(read_input_file(file, file.string(), "a file"), json, own);
  for (const Fault& fault : own.all()) faults.add(file.string() + " " + fault.pointer, fault.value, fault.expected);
  if (is_json && !json.is_object()) faults.add(file.string(), shown(json), "an object");
  return is_json && json.is_object() ? json : Json(nullptr);
}

RunRecord read_run(const fs::path& folder, Faults& faults) {
  RunRecord run;
  run.folder = folder;
  run.summary = read_json_object(folder / "summary.json", faults);
  if (!run.summary.is_null() && run.word("/status").empty())
    faults.add((folder / "summary.json").string() + " /status", "", "\"done\", \"failed\" or \"interrupted\"");
  run.scene = read_json_object(folder / "scene.resolved.json", faults);
  if (run.scene.is_null()) run.notes.emplace_back("scene.resolved.json is not there: what the scene was is not known.");
  run.history = read_table(folder / "history.csv", run, faults);
  check_history(run, faults);
  if (run.history.rows() == 0) run.notes.emplace_back("history.csv has no record yet: nothing can be said of energies over time.");
  read_probes(run, faults);
  run.first_break = read_first_break(folder / "failures.csv");
  run.has_failing_motion = fs::exists(folder / failing_motion_file);
  run.has_checkpoint = fs::exists(folder / checkpoint_file);
  run.pictures = find_pictures(folder, run.scene);
  return run;
}

}  // namespace hyperlattice::report
