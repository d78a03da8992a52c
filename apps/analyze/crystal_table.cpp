#include <analyze/crystals.hpp>
#include <base/csv.hpp>
#include <base/input_file.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>

namespace hyperlattice {

namespace {

struct Columns {
  static constexpr std::array<const char*, 4> names{"name", "C11_GPa", "C12_GPa", "C44_GPa"};
  std::array<std::size_t, 4> at{};
  std::optional<std::size_t> reliability;
};

/// Returns the columns of a table. Throws InputError if one that is needed is missing.
Columns columns_of(const CsvReader& table, const std::string& file) {
  Faults faults;
  Columns columns;
  for (std::size_t n = 0; n < columns.at.size(); ++n)
    if (const auto place = find_column(table.columns(), Columns::names[n]))
      columns.at[n] = *place;
    else
      faults.add(fmt::format("{}:{}", file, table.columns_line()), table.columns_text(),
                 fmt::format("a column {}, named in the first line", Columns::names[n]));
  faults.throw_if_any();
  columns.reliability = find_column(table.columns(), "reliability");
  return columns;
}

/// Reads the constants of one line. Adds a fault if they do not belong to a stable crystal.
std::optional<Crystal> crystal_of(const std::vector<std::string>& cells, const Columns& columns,
                                  const std::string& where, Faults& faults) {
  if (cells.size() <= *std::max_element(columns.at.begin(), columns.at.end())) {
    faults.add(where, cells.front(),
               "a value in each of the columns name, C11_GPa, C12_GPa, C44_GPa");
    return std::nullopt;
  }
  Crystal crystal;
  crystal.name = cells[columns.at[0]];
  if (columns.reliability && *columns.reliability < cells.size())
    crystal.reliability = cells[*columns.reliability];
  const std::array<double*, 3> constants{&crystal.C11, &crystal.C12, &crystal.C44};
  const std::size_t before = faults.size();
  for (std::size_t n = 0; n < constants.size(); ++n) {
    const std::string& cell = cells[columns.at[n + 1]];
    if (const auto number = csv_number(cell))
      *constants[n] = *number;
    else
      faults.add(where, cell, fmt::format("a number in column {}", Columns::names[n + 1]));
  }
  if (faults.size() > before) return std::nullopt;
  if (crystal.C44 > 0 && crystal.C11 > crystal.C12 && crystal.C11 + 2 * crystal.C12 > 0)
    return crystal;
  faults.add(where, crystal.name,
             "constants of a stable crystal: C44 > 0, C11 > C12, C11 + 2 C12 > 0");
  return std::nullopt;
}

}  // namespace

std::vector<Crystal> read_crystals(const std::filesystem::path& file) {
  const std::string text = read_input_file(file, "--crystals", "a table of crystals");
  CsvReader table(text);
  Faults faults;
  std::vector<Crystal> crystals;
  if (!table.columns().empty()) {
    const Columns columns = columns_of(table, file.string());
    while (table.next())
      if (auto crystal = crystal_of(table.cells(), columns,
                                    fmt::format("{}:{}", file.string(), table.line()), faults))
        crystals.push_back(*crystal);
  }
  if (crystals.empty() && faults.empty()) faults.add(file.string(), "", "at least one crystal");
  faults.throw_if_any();
  return crystals;
}

}  // namespace hyperlattice
