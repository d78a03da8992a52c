#include <base/figures.hpp>
#include <base/probe_column.hpp>
#include <report/pictures.hpp>
#include <report/probe_curves.hpp>

#include <hyperlattice/field_table.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace hyperlattice::report {

namespace {

constexpr std::size_t most_profiles = 5;

/// Returns the field of a column: its name is the longest with which the column begins. Null: none.
const FieldInfo* field_of(const std::string& column) {
  const FieldInfo* found = nullptr;
  for (const FieldInfo& field : field_table)
    if (column.starts_with(field.name) &&
        (found == nullptr || field.name.size() > found->name.size()))
      found = &field;
  return found;
}

std::string unit_of(const std::string& column) {
  if (const FieldInfo* field = field_of(column)) return std::string(field->unit);
  static constexpr std::pair<const char*, const char*> units[] = {
      {"radius", "m"},     {"elongation", "m"},  {"force", "N"},   {"moment", "N m"},
      {"area", "m2"},      {"size", "m"},        {"kinetic", "J"}, {"spin", "rad/s"},
      {"dust_mass", "kg"}, {"dust_kinetic", "J"}};
  for (const auto& [name, unit] : units)
    if (column.starts_with(name)) return unit;
  return "";
}

bool ends_in(const std::string& name, std::initializer_list<const char*> endings) {
  return std::any_of(endings.begin(), endings.end(),
                     [&](const char* ending) { return name.ends_with(ending); });
}

/// Returns whether a column is one of several numbered ones: "mass_0", "mass_1".
bool is_numbered(const std::string& name) {
  const std::size_t bar = name.rfind('_');
  return bar != std::string::npos && bar + 1 < name.size() &&
         name.find_first_not_of("0123456789", bar + 1) == std::string::npos &&
         find_field(name) == nullptr;
}

/// Returns the name of the plot of a column: the statistics of a number, the components of a
/// vector, or numbered columns share one plot.
std::string quantity_of(const std::string& name) {
  const std::size_t bar = name.rfind('_');
  if (is_numbered(name)) return name.substr(0, bar);
  const bool is_statistic = ends_in(name, {"_mean", "_min", "_max"});
  return is_statistic || (find_field_part(name).field != nullptr && find_field(name) == nullptr)
             ? name.substr(0, bar)
             : name;
}

/// Groups the columns of a probe by the name that `key` returns, in the order of the table.
std::vector<std::pair<std::string, std::vector<std::size_t>>> grouped(
    const Columns& table, std::string (*key)(const std::string&)) {
  std::vector<std::pair<std::string, std::vector<std::size_t>>> groups;
  for (std::size_t c = 1; c < table.names.size(); ++c) {
    const std::string name = key(table.names[c]);
    const auto found = std::find_if(groups.begin(), groups.end(),
                                    [&](const auto& group) { return group.first == name; });
    if (found == groups.end())
      groups.push_back({name, {c}});
    else
      found->second.push_back(c);
  }
  return groups;
}

bool is_along_places(const Columns& table) {
  const auto groups = grouped(table, column_name);
  return std::any_of(groups.begin(), groups.end(),
                     [&](const auto& group) { return group.second.size() > 1; }) &&
         std::all_of(table.names.begin() + 1, table.names.end(),
                     [](const std::string& name) { return column_place(name).has_value(); });
}

/// Returns the values of the columns in one row, over the distance of their places from the first
/// place, m.
Series profile(const Columns& table, const std::vector<std::size_t>& columns, std::size_t row,
               std::string label) {
  Series series{std::move(label), {}, {}};
  const auto first = *column_place(table.names[columns.front()]);
  for (const std::size_t c : columns) {
    const auto place = *column_place(table.names[c]);
    series.x.push_back(std::hypot(place[0] - first[0], place[1] - first[1], place[2] - first[2]));
    series.y.push_back(table.values[c][row]);
  }
  return series;
}

/// Returns some rows with different times; of several rows with one time, the last.
std::vector<std::size_t> chosen_rows(const Columns& table) {
  const auto& time = table.values.front();
  std::vector<std::size_t> last;
  for (std::size_t n = 0; n < time.size(); ++n)
    if (n + 1 == time.size() || time[n + 1] != time[n]) last.push_back(n);
  std::vector<std::size_t> chosen;
  for (const std::size_t n : evenly(last.size(), most_profiles)) chosen.push_back(last[n]);
  return chosen;
}

Plot along(const std::string& probe, const std::string& name) {
  return {fmt::format("Probe {}: {}", probe, name),
          {"distance from the first place", "m"},
          {name, unit_of(name)},
          {}};
}

Plot over_time(const std::string& probe, const std::string& name) {
  return {fmt::format("Probe {}: {}", probe, name), {"time", "s"}, {name, unit_of(name)}, {}};
}

}  // namespace

std::vector<Plot> plots_of(const Probe& probe) {
  const Columns& table = probe.table;
  std::vector<Plot> plots;
  if (table.rows() == 0) return plots;
  if (is_along_places(table)) {
    for (const auto& [name, columns] : grouped(table, column_name)) {
      Plot& plot = plots.emplace_back(along(probe.name, name));
      for (const std::size_t row : chosen_rows(table))
        plot.series.push_back(
            profile(table, columns, row, "at " + quantity_text(table.values.front()[row], "s")));
    }
    return plots;
  }
  for (const auto& [name, columns] :
       grouped(table, [](const std::string& column) { return quantity_of(column_name(column)); })) {
    // a single curve has no legend, so that the title gives the full name of its column
    Plot& plot = plots.emplace_back(over_time(
        probe.name, columns.size() == 1 ? column_name(table.names[columns.front()]) : name));
    for (const std::size_t c : columns)
      plot.series.push_back({table.names[c], table.values.front(), table.values[c]});
  }
  return plots;
}

std::vector<Plot> probes_together(std::span<const RunRecord> runs) {
  std::vector<Plot> plots;
  // Index of the plot, by probe and number.
  std::map<std::pair<std::string, std::string>, std::size_t> place;
  for (const RunRecord& run : runs)
    for (const Probe& probe : run.probes) {
      const Columns& table = probe.table;
      const bool is_profile = is_along_places(table);
      if (table.rows() == 0) continue;
      for (const auto& [name, columns] : grouped(table, column_name)) {
        if (ends_in(name, {"_min", "_max"})) continue;  // comparisons show only the mean
        const auto [found, is_new] = place.try_emplace({probe.name, name}, plots.size());
        if (is_new)
          plots.push_back(is_profile ? along(probe.name, name) : over_time(probe.name, name));
        Plot& plot = plots[found->second];
        if (is_profile != (plot.x.unit == "m"))
          continue;  // another kind of probe with the same name
        plot.series.push_back(
            is_profile ? profile(table, columns, table.rows() - 1, run.label)
                       : Series{run.label, table.values.front(), table.values[columns.front()]});
      }
    }
  std::erase_if(plots, [](const Plot& plot) { return plot.series.size() < 2; });
  return plots;
}

}  // namespace hyperlattice::report
