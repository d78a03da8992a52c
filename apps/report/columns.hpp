// A table of numbers that a run wrote, stored by column.
#pragma once

#include <base/errors.hpp>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace hyperlattice::report {

/// A table of numbers.
struct Columns {
  std::vector<std::string> names;
  /// One vector for each name, all of the same length; may contain nan and infinity.
  std::vector<std::vector<double>> values;
  /// The file ends within a line, because the run goes on or was killed; that line is left out.
  bool is_cut = false;

  std::size_t rows() const { return values.empty() ? 0 : values.front().size(); }
  /// Returns the column of this name; null if there is none.
  const std::vector<double>* find(std::string_view name) const;
};

/// Parses a table. Adds a fault at `file` if the first line is missing, and for the first invalid
/// line.
Columns read_columns(const std::filesystem::path& file, std::string_view text, Faults& faults);

}  // namespace hyperlattice::report
