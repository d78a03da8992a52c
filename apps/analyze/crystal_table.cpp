#include <analyze/crystals.hpp>
#include <base/csv.hpp>
#include <base/input_file.hpp>

#include <hyperlattice/tables.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <sstream>

namespace hyperlattice {

namespace {

struct Columns {
  static constexpr std::array<const char*, 4> names{"name", "C11_GPa", "C12_GPa", "C44_GPa"};
  std::array<std::size_t, 4> at{};
  std::optional<std::size_t> reliability;
};

std::optional<Columns> columns_of(const TableColumns& header, const std::string& file,
                                  Faults& faults) {
  const std::size_t before = faults.size();
  Columns columns;
  for (std::size_t n = 0; n < columns.at.size(); ++n)
    if (const auto place = header.find(Columns::names[n]))
      columns.at[n] = *place;
    else
      faults.add(file + ":1", header.text(),
                 fmt::format("a column {}, named in the first line", Columns::names[n]));
  columns.reliability = header.find("reliability");
  return faults.size() > before ? std::nullopt : std::optional(columns);
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
  std::istringstream stream(read_input_file(file, "--crystals", "a table of crystals"));
  Faults faults;
  std::vector<Crystal> crystals;
  std::optional<TableColumns> header;
  std::optional<Columns> columns;
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (!header) {
      columns = columns_of(header.emplace(line), file.string(), faults);
      faults.throw_if_any();
    } else if (!TableColumns::is_empty(line)) {
      if (auto crystal = crystal_of(header->cells(line), *columns,
                                    fmt::format("{}:{}", file.string(), number), faults))
        crystals.push_back(*crystal);
    }
  }
  if (crystals.empty() && faults.empty()) faults.add(file.string(), "", "at least one crystal");
  faults.throw_if_any();
  return crystals;
}

}  // namespace hyperlattice
