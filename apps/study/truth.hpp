// The truth of a study: a table, numbers, or the study's own finest run.
#pragma once

#include <base/csv.hpp>
#include <study/axes.hpp>
#include <study/plain_reader.hpp>

#include <filesystem>
#include <map>
#include <memory>
#include <optional>

namespace hyperlattice::study {

/// Which rows of a truth's table count: those with this value in a column.
struct RowFilter {
  std::string column;
  std::string text;              ///< the value, if it is no number
  std::optional<double> number;  ///< the value, if it is one
  std::optional<std::size_t>
      axis;  ///< the value is what this axis was set to, a number in SI times `scale`
  double scale = 1;
};

struct Truth {
  enum class Kind { table, numbers, finest };

  std::string pointer;  ///< where it stands in the study
  Condition when;       ///< of several truths the first one whose condition holds counts
  Kind kind = Kind::numbers;
  std::filesystem::path file;             ///< table: where it is
  std::shared_ptr<const CsvTable> table;  ///< table
  std::optional<std::string> over;        ///< table: the column of time or place
  double over_scale = 1;                  ///< table: times what stands there
  std::vector<RowFilter> where;           ///< table
  std::map<std::string, double> numbers;  ///< numbers: by name; a single one has the name ""
  std::optional<double>
      order;  ///< finest: the order of convergence assumed; the one observed if there is none
};

/// Reads the study's "truth": one, or a list of them. Paths are relative to `folder`.
std::vector<Truth> read_truths(const Json& given, const std::filesystem::path& folder,
                               const std::vector<Axis>& axes, PlainReader& reader);

/// Reads { "<column>": value, or { "axis": name, "scale": number }, ... }.
std::vector<RowFilter> read_filters(const Json& given, const std::string& pointer,
                                    const std::vector<Axis>& axes, PlainReader& reader);

/// Whether a row of the table fulfils all conditions; `numbers` has what each axis is set to, in
/// SI, where it is a number.
bool passes(const CsvTable& table, std::size_t row, const std::vector<RowFilter>& filters,
            const std::vector<std::optional<double>>& numbers);

}  // namespace hyperlattice::study
