// Reads tests/data/nu_eta_table.csv: elastic constants for the five membranes, computed
// independently of this program.
#pragma once

#include <base/csv.hpp>
#include <base/input_file.hpp>

#include <hyperlattice/calibration.hpp>

#include <spdlog/fmt/fmt.h>

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace hyperlattice::test {

struct Row {
  calibration::Membrane membrane = calibration::Membrane::none;
  std::map<std::string, std::string> values;  ///< text of a cell by the name of its column
  std::string text;                           ///< the whole row

  double number(const std::string& column) const { return std::stod(values.at(column)); }
};
using Rows = std::vector<Row>;

inline Rows nu_eta_table() {
  const CsvTable table = parse_csv(read_input_file(
      std::string(HYPERLATTICE_SOURCE) + "/tests/data/nu_eta_table.csv", "", "a table"));
  Rows rows;
  for (const std::vector<std::string>& cells : table.rows) {
    Row row;
    row.text = fmt::format("{}", fmt::join(cells, ","));
    for (std::size_t c = 0; c < cells.size(); ++c) row.values[table.columns[c]] = cells[c];
    for (std::uint32_t m = 0; m < std::size(calibration::membrane_names); ++m)
      if (calibration::membrane_names[m] == row.values["lattice"])
        row.membrane = static_cast<calibration::Membrane>(m);
    if (row.membrane == calibration::Membrane::none)
      throw std::runtime_error("no membrane: " + row.text);
    rows.push_back(row);
  }
  if (rows.empty()) throw std::runtime_error("nu_eta_table.csv is empty");
  return rows;
}

}  // namespace hyperlattice::test
