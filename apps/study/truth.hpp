// The truth of a study: a table, numbers, or the limit of the study's own runs.
#pragma once

#include <base/csv.hpp>
#include <study/axes.hpp>
#include <study/object_reader.hpp>

#include <filesystem>
#include <map>
#include <memory>
#include <optional>

namespace hyperlattice::study {

/// Selects the rows of a table that have this value in a column.
struct RowFilter {
  std::string column;
  std::string text;              ///< the value, if it is a text
  std::optional<double> number;  ///< the value, if it is a number
  /// The value is the value of this axis, a number in SI, times `scale`.
  std::optional<std::size_t> axis;
  double scale = 1;
};

/// One truth of a study.
struct Truth {
  enum class Kind { table, numbers, finest };

  std::string pointer;  ///< JSON pointer into the study
  Condition when;       ///< of several truths, the first whose condition holds is used
  Kind kind = Kind::numbers;
  std::filesystem::path file;             ///< table: its file
  std::shared_ptr<const CsvTable> table;  ///< table
  std::optional<std::string> over;        ///< table: column of time or place
  double over_scale = 1;                  ///< table: factor for the values of that column
  std::vector<RowFilter> where;           ///< table
  std::map<std::string, double> numbers;  ///< numbers: by name; a single number has the name ""
  /// finest: the assumed order of convergence; if empty, the observed order.
  std::optional<double> order;
};

/// Reads the study's "truth", one or a list. Paths are relative to `folder`.
std::vector<Truth> read_truths(const Json& given, const std::filesystem::path& folder,
                               const std::vector<Axis>& axes, ObjectReader& reader);

/// Reads { "<column>": value, or { "axis": name, "scale": number }, ... }.
std::vector<RowFilter> read_filters(const Json& given, const std::string& pointer,
                                    const std::vector<Axis>& axes, ObjectReader& reader);

/// Returns whether a row of the table passes all filters. `numbers`: the value of each axis in SI,
/// if it is a number.
bool passes(const CsvTable& table, std::size_t row, const std::vector<RowFilter>& filters,
            const std::vector<std::optional<double>>& numbers);

}  // namespace hyperlattice::study
