// Reads tests/data/nu_eta_table.csv: elastic constants for the five membranes, computed
// independently of this program.
#pragma once

#include <hyperlattice/calibration.hpp>

#include <fstream>
#include <map>
#include <sstream>
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
  std::ifstream file(std::string(HYPERLATTICE_SOURCE) + "/tests/data/nu_eta_table.csv");
  std::string line, cell;
  std::vector<std::string> columns;
  std::getline(file, line);
  for (std::istringstream cells(line); std::getline(cells, cell, ',');) columns.push_back(cell);
  Rows rows;
  while (std::getline(file, line)) {
    Row row;
    row.text = line;
    std::istringstream cells(line);
    for (const std::string& column : columns) std::getline(cells, row.values[column], ',');
    for (std::uint32_t m = 0; m < std::size(calibration::membrane_names); ++m)
      if (calibration::membrane_names[m] == row.values["lattice"])
        row.membrane = static_cast<calibration::Membrane>(m);
    if (row.membrane == calibration::Membrane::none)
      throw std::runtime_error("no membrane: " + line);
    rows.push_back(row);
  }
  if (rows.empty()) throw std::runtime_error("nu_eta_table.csv is empty or missing");
  return rows;
}

}  // namespace hyperlattice::test
