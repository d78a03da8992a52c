// A table of numbers as a run leaves it, column by column.
#pragma once

#include <base/errors.hpp>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace hyperlattice::report {

struct Columns {
  std::vector<std::string> names;
  std::vector<std::vector<double>>
      values;  ///< one a name, all of one length; "nan" and "inf" are read as what they are
  bool is_cut =
      false;  ///< the file ended within a line, which is left out: its run goes on, or was killed

  std::size_t rows() const { return values.empty() ? 0 : values.front().size(); }
  const std::vector<double>* find(
      std::string_view name) const;  ///< null if there is no such column
};

/// A table from its text; adds a fault at `file` for a missing first line, and for the first line
/// that is wrong.
Columns read_columns(const std::filesystem::path& file, std::string_view text, Faults& faults);

}  // namespace hyperlattice::report
