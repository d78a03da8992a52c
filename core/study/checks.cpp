#include <scene/expectation.hpp>
#include <study/checks.hpp>
#include <study/observe.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <fstream>

namespace hyperlattice::study {

void RunFaults::add(const InputError& error, const std::string& run, const std::string& prefix) {
  for (const Fault& fault : error.faults()) {
    const std::string pointer = prefix + fault.pointer;
    const auto same = [&](const Found& other) {
      return other.fault.pointer == pointer && other.fault.value == fault.value && other.fault.expected == fault.expected;
    };
    auto found = std::find_if(found_.begin(), found_.end(), same);
    if (found == found_.end()) found = found_.insert(found_.end(), Found{Fault{pointer, fault.value, fault.expected}, {}});
    found->runs.push_back(run);
  }
}

void RunFaults::throw_if_any(std::size_t runs) const {
  Faults faults;
  for (const auto& [fault, in] : found_) {
    const std::string more = in.size() > 1 ? fmt::format(" and {} more", in.size() - 1) : "";
    faults.add(fault.pointer + (in.size() == runs ? "" : fmt::format(" (run {}{})", in.front(), more)), fault.value, fault.expected);
  }
  faults.throw_if_any();
}

void check_columns(const Study& study, const std::vector<PlannedTable>& tables) {
  Faults faults;
  std::vector<std::string> probes;
  probes.reserve(tables.size());
  for (const PlannedTable& table : tables) probes.push_back(table.probe);
  for (const Comparison& comparison : study.comparisons) {
    const auto table = std::find_if(tables.begin(), tables.end(), [&](const PlannedTable& t) { return t.probe == comparison.probe; });
    if (table == tables.end()) {
      faults.add(comparison.pointer + "/probe", shown(comparison.probe),
                 fmt::format("a probe of the scene by its name: {}", fmt::join(probes, ", ")) + did_you_mean(comparison.probe, probes));
      continue;
    }
    const auto& columns = table->columns;
    const std::string why = column_fault(comparison, columns);
    if (!why.empty()) faults.add(comparison.pointer + "/column", shown(comparison.column), why);
    if (comparison.at_column && std::find(columns.begin(), columns.end(), *comparison.at_column) == columns.end())
      faults.add(comparison.pointer + "/at", shown(*comparison.at_column),
                 fmt::format("a length, or a column of the probe: {}", fmt::join(columns, ", ")) + did_you_mean(*comparison.at_column, columns));
  }
  faults.throw_if_any();
}

std::vector<PlannedTable> tables_in(const std::filesystem::path& run_directory) {
  std::vector<PlannedTable> tables;
  std::error_code none;
  for (const auto& file : std::filesystem::directory_iterator(run_directory / "probes", none)) {
    std::ifstream stream(file.path());
    std::string header;
    std::getline(stream, header);
    if (file.path().extension() == ".csv") tables.push_back({file.path().stem().string(), csv_cells(header)});
  }
  return tables;
}

}  // namespace hyperlattice::study
