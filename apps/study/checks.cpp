#include <base/content_hash.hpp>
#include <base/folder_file.hpp>
#include <base/own_files.hpp>
#include <scene/expectation.hpp>
#include <study/checks.hpp>
#include <study/expected.hpp>
#include <study/observe.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

namespace hyperlattice::study {

void RunFaults::add(const InputError& error, const std::string& run, const std::string& prefix) {
  for (const Fault& fault : error.faults()) {
    const std::string pointer = prefix + fault.pointer;
    const auto same = [&](const SharedFault& other) {
      return other.fault.pointer == pointer && other.fault.value == fault.value &&
             other.fault.expected == fault.expected;
    };
    auto found = std::find_if(found_.begin(), found_.end(), same);
    if (found == found_.end())
      found =
          found_.insert(found_.end(), SharedFault{Fault{pointer, fault.value, fault.expected}, {}});
    found->runs.push_back(run);
  }
}

void RunFaults::throw_if_any(std::size_t runs) const {
  Faults faults;
  for (const auto& [fault, in] : found_) {
    const std::string more = in.size() > 1 ? fmt::format(" and {} more", in.size() - 1) : "";
    faults.add(
        fault.pointer + (in.size() == runs ? "" : fmt::format(" (run {}{})", in.front(), more)),
        fault.value, fault.expected);
  }
  faults.throw_if_any();
}

void check_columns(const Study& study, const std::vector<PlannedTable>& tables) {
  Faults faults;
  std::vector<std::string> probes;
  probes.reserve(tables.size());
  for (const PlannedTable& table : tables)
    if (!table.probe.empty()) probes.push_back(table.probe);
  for (const Comparison& comparison : study.comparisons) {
    const auto table = std::find_if(tables.begin(), tables.end(), [&](const PlannedTable& t) {
      return t.probe == comparison.probe;
    });
    if (table == tables.end()) {
      faults.add(comparison.pointer + "/probe", shown(comparison.probe),
                 fmt::format("a probe of the scene by its name: {}", fmt::join(probes, ", ")) +
                     did_you_mean(comparison.probe, probes));
      continue;
    }
    const auto& columns = table->columns;
    const std::string why = column_fault(comparison, columns);
    if (!why.empty()) faults.add(comparison.pointer + "/column", shown(comparison.column), why);
    if (comparison.at_column &&
        std::find(columns.begin(), columns.end(), *comparison.at_column) == columns.end())
      faults.add(comparison.pointer + "/at", shown(*comparison.at_column),
                 fmt::format("a length, or a column of the probe: {}", fmt::join(columns, ", ")) +
                     did_you_mean(*comparison.at_column, columns));
  }
  faults.throw_if_any();
}

namespace {

/// Returns why a truth over time cannot be compared with a run; empty if no reason is known.
std::string fault_of_times(const Comparison& comparison, const Truth& truth, const Curve& curve,
                           const RunProperties* run) {
  if (run == nullptr || truth.kind != Truth::Kind::table || comparison.along ||
      comparison.reduction != Reduction::none)
    return "";
  const Curve times{{0, run->end_time + run->step}, {0, 0}};
  const auto reached = [&](double time) { return !std::isnan(value_at(times, time)); };
  if (run->end_time == infinity || std::any_of(curve.over.begin(), curve.over.end(), reached))
    return "";
  return fmt::format(
      "a truth of \"{}\" at times in s that the run reaches, which ends at {:.6g} s; \"{}\" of {}, "
      "times its scale, is from {:g} to {:g}",
      comparison.name, run->end_time, over_column(comparison, truth),
      truth.file.filename().string(), curve.over.front(), curve.over.back());
}

}  // namespace

void check_truth(const Study& study, const Row& row, const RunProperties* properties) {
  if (study.is_sweep()) return;
  const Truth& truth = *std::find_if(study.truths.begin(), study.truths.end(),
                                     [&](const Truth& t) { return t.when.holds(row.choice); });
  if (truth.kind == Truth::Kind::finest) return;
  Faults faults;
  const auto refuse = [&](const std::string& place, const Comparison& comparison,
                          const std::runtime_error& error) {
    faults.add(place, "",
               fmt::format("a truth of \"{}\" for every run; {}", comparison.name, error.what()));
  };
  bool all_zero = true;
  std::string zero;  // JSON pointer to the latest zero truth
  for (const Comparison& comparison : study.comparisons) {
    const std::string place = truth.kind == Truth::Kind::table ? truth.pointer + "/csv"
                              : comparison.truth.empty()
                                  ? truth.pointer + "/value"
                                  : member(truth.pointer + "/values", comparison.truth);
    if (comparison.at_column) {  // the place is known only after the run
      all_zero = false;
      std::string fault;  // the columns of all places have the same times
      try {
        if (truth.table)
          for (const auto& [at, column] : placed_columns(*truth.table, comparison.truth))
            fault = fault_of_times(comparison, truth,
                                   true_curve(comparison, truth, at, row.numbers), properties);
        if (!fault.empty()) faults.add(place, "", fault);
      } catch (const std::runtime_error& error) {
        refuse(place, comparison, error);
      }
      continue;
    }
    try {
      const Curve curve = true_curve(comparison, truth, comparison.at, row.numbers);
      const bool is_zero = std::all_of(curve.values.begin(), curve.values.end(),
                                       [](double value) { return value == 0; });
      if (!std::all_of(curve.values.begin(), curve.values.end(),
                       [](double value) { return std::isfinite(value); }))
        faults.add(place, "",
                   fmt::format("a truth of \"{}\" that is finite with its scale", comparison.name));
      if (const std::string fault = fault_of_times(comparison, truth, curve, properties);
          !fault.empty())
        faults.add(place, "", fault);
      all_zero = all_zero && is_zero;
      if (is_zero) zero = place;
      if (is_zero && study.norm != Norm::together_l2)
        faults.add(place, "0",
                   fmt::format("a truth of \"{}\" that is not zero, since the error is relative to "
                               "it; or \"error\": \"together_l2\"",
                               comparison.name));
    } catch (const std::runtime_error& error) {
      refuse(place, comparison, error);
    }
  }
  if (study.norm == Norm::together_l2 && all_zero && faults.empty())
    faults.add(zero, "0",
               "at least one quantity whose truth is not zero, since the error is relative to all "
               "of them together");
  faults.throw_if_any();
}

std::optional<std::vector<PlannedTable>> tables_in(const std::filesystem::path& run_directory,
                                                   const Scene& scene) {
  // In bytes; the first line is long if a probe has many places.
  constexpr std::uint64_t longest_head = 64 << 20;
  std::vector<PlannedTable> tables;
  const auto add = [&](const std::string& probe, const std::string& name) {
    const auto file = read_folder_file(run_directory, name, longest_head, true);
    if (!file || !file->refusal.empty()) return false;
    tables.push_back(
        {probe, csv_cells(std::string_view(file->text).substr(0, file->text.find('\n')))});
    return true;
  };
  if (!add("", "history.csv")) return std::nullopt;
  for (const Stage* probe : scene.of(Family::probes))
    if (!add(probe->name, "probes/" + probe->name + ".csv")) return std::nullopt;
  return tables;
}

std::string changed_table(const std::filesystem::path& run_directory, const Scene& scene) {
  const auto own = read_own_files(run_directory);
  if (!own) return fmt::format("its {} is missing", own_files_list);
  std::vector<std::string> names{"history.csv"};
  for (const Stage* probe : scene.of(Family::probes))
    names.push_back("probes/" + probe->name + ".csv");
  for (const std::string& name : names) {
    if (!has_folder_file(run_directory, name)) return name + " is missing";
    const auto file = own->find(name);
    if (file == own->end() || file->second.hash.empty())
      return fmt::format("{} does not say how {} was", own_files_list, name);
    const std::filesystem::path path = run_directory / name;
    std::error_code error;
    if (std::filesystem::file_size(path, error) != file->second.bytes ||
        hash_of_file(path) != file->second.hash)
      return name + " has changed";
  }
  return "";
}

}  // namespace hyperlattice::study
