#include <base/probe_column.hpp>
#include <scene/expectation.hpp>
#include <study/observe.hpp>

#include <spdlog/fmt/fmt.h>

#include <stdexcept>

namespace hyperlattice::study {

namespace {

/// Returns the columns with the name of the comparison, with or without "@<place>".
std::vector<std::size_t> columns_of(const Comparison& comparison,
                                    const std::vector<std::string>& columns) {
  std::vector<std::size_t> found;
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (columns[c] == comparison.column || columns[c].starts_with(comparison.column + "@"))
      found.push_back(c);
  return found;
}

/// Returns a coordinate, m, of the place in a column's name; nothing if it has no place.
std::optional<double> coordinate_in(const std::string& column, Coordinate coordinate) {
  const auto place = column_place(column);
  return place ? std::optional<double>((*place)[static_cast<std::size_t>(coordinate)])
               : std::nullopt;
}

double number_in(const CsvTable& table, std::size_t row, std::size_t column) {
  const auto number = csv_number(table.rows[row][column]);
  if (!number)
    throw std::runtime_error(fmt::format("\"{}\" in row {} of column {} is no number",
                                         table.rows[row][column], row + 1, table.columns[column]));
  return *number;
}

}  // namespace

std::string column_fault(const Comparison& comparison, const std::vector<std::string>& columns) {
  const auto found = columns_of(comparison, columns);
  std::vector<std::string> names;
  for (const std::string& column : columns)
    if (const std::string name = column_name(column); names.empty() || names.back() != name)
      names.push_back(name);
  if (found.empty())
    return fmt::format("a column of {}: {}", comparison.table(), fmt::join(names, ", ")) +
           did_you_mean(comparison.column, names);
  if (!comparison.along)
    return found.size() == 1 ? ""
                             : fmt::format(
                                   "one column; {} are called so: name one in full, or compare "
                                   "them \"along\" a coordinate",
                                   found.size());
  for (const std::size_t c : found)
    if (!coordinate_in(columns[c], *comparison.along))
      return fmt::format(
          "columns with their places behind an \"@\", because of \"along\"; \"{}\" has none",
          columns[c]);
  return "";
}

Curve observed_curve(const Comparison& comparison, const CsvTable& table) {
  if (const std::string fault = column_fault(comparison, table.columns); !fault.empty())
    throw std::runtime_error("expected " + fault);
  if (table.rows.empty())
    throw std::runtime_error(fmt::format("the table of {} has no rows", comparison.table()));
  const auto columns = columns_of(comparison, table.columns);
  Curve curve;
  if (comparison.along) {
    for (const std::size_t c : columns) {
      curve.over.push_back(*coordinate_in(table.columns[c], *comparison.along));
      curve.values.push_back(number_in(table, table.rows.size() - 1, c));
    }
  } else {
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
      curve.over.push_back(number_in(table, row, 0));
      curve.values.push_back(number_in(table, row, columns.front()));
    }
  }
  return sorted(std::move(curve));
}

std::optional<double> place_of(const Comparison& comparison, const CsvTable& table) {
  if (!comparison.at_column) return comparison.at;
  const auto column = table.column(*comparison.at_column);
  if (!column || table.rows.empty())
    throw std::runtime_error(fmt::format("the probe has no column {}", *comparison.at_column));
  return number_in(table, 0, *column);
}

}  // namespace hyperlattice::study
