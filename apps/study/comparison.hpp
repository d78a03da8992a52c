// What a study compares: columns of the runs' probes with the truth.
#pragma once

#include <study/curve.hpp>
#include <study/truth.hpp>

namespace hyperlattice::study {

enum class Coordinate { x, y, z };
inline constexpr std::string_view coordinate_names[] = {"x", "y", "z"};

/// One quantity of a run, over time or, at the last time, along a line of places, and what of the
/// truth it is compared with.
struct Comparison {
  std::string pointer, name;
  std::string probe;   ///< name of the probe's stage
  std::string column;  ///< of the probe's table, with or without the "@(x y z)" that says where a
                       ///< particle stands
  std::optional<Coordinate>
      along;  ///< the last row's columns of many particles over this coordinate of their places
  Reduction reduction = Reduction::none;

  std::string truth;  ///< the truth's column or number
  std::optional<double>
      at;  ///< the place in metres at which the truth is taken from columns "<truth>@<place>"
  std::optional<std::string>
      at_column;  ///< the same place, from the first row of this column of the probe's table
  std::optional<std::string> over;  ///< in place of the truth's own
  std::optional<double> over_scale;
  std::vector<RowFilter> where;  ///< beside the truth's own
  double scale = 1;              ///< the truth's value times this is the run's in SI

  bool has_place() const { return at || at_column; }
};

/// Reads the study's "compare" and checks it against the truths. Names the columns of a truth's
/// table that are missing.
std::vector<Comparison> read_comparisons(const Json& given, const std::vector<Truth>& truths,
                                         const std::vector<Axis>& axes, PlainReader& reader);

/// The column of time or place of a truth's table: the comparison's own, the truth's, or the usual
/// one ("t" or "time"; the coordinate).
std::string over_column(const Comparison& comparison, const Truth& truth);

/// Columns "<name>@<place>" of a table with their places in metres, ascending.
std::vector<std::pair<double, std::size_t>> placed_columns(const CsvTable& table,
                                                           const std::string& name);

}  // namespace hyperlattice::study
