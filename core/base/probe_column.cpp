#include <base/csv.hpp>
#include <base/probe_column.hpp>

#include <sstream>

namespace hyperlattice {

std::string column_name(const std::string& column) { return column.substr(0, column.find('@')); }

std::optional<std::array<double, 3>> column_place(const std::string& column) {
  const auto open = column.find("@(");
  if (open == std::string::npos || column.back() != ')') return std::nullopt;
  std::istringstream words(column.substr(open + 2, column.size() - open - 3));
  std::array<double, 3> place{};
  for (double& coordinate : place) {
    std::string word;
    words >> word;
    const auto number = csv_number(word);
    if (!number) return std::nullopt;
    coordinate = *number;
  }
  return place;
}

}  // namespace hyperlattice
