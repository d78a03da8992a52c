// The comparisons of a study: columns of the runs' tables against the truth.
#pragma once

#include <study/curve.hpp>
#include <study/truth.hpp>

namespace hyperlattice::study {

enum class Coordinate { x, y, z };
inline constexpr std::string_view coordinate_names[] = {"x", "y", "z"};

/// One compared quantity of a run, over time, or along a line of places at the last time, and its
/// counterpart in the truth.
struct Comparison {
  std::string pointer, name;
  std::string probe;  ///< name of the probe; empty: the history of the run
  /// Column of the probe's table, with or without the place of a particle, "@(x y z)".
  std::string column;
  /// Compares the last row of the columns of many particles over this coordinate of their places.
  std::optional<Coordinate> along;
  Reduction reduction = Reduction::none;

  std::string truth;  ///< column or number of the truth
  /// The place, m, at which columns "<truth>@<place>" give the truth.
  std::optional<double> at;
  /// This column of the probe's table has that place in its first row.
  std::optional<std::string> at_column;
  std::optional<std::string> over;  ///< replaces Truth::over
  std::optional<double> over_scale;
  std::vector<RowFilter> where;  ///< in addition to the filters of the truth
  double scale = 1;              ///< the truth times this number is in the SI unit of the run

  /// The file of a run that has the column, in the folder of the run, and its name in messages.
  std::string file() const { return probe.empty() ? "history.csv" : "probes/" + probe + ".csv"; }
  std::string table() const { return probe.empty() ? "history.csv" : "probe " + probe; }
  bool has_place() const { return at || at_column; }
};

/// Reads the study's "compare" and checks it against the truths. Adds a fault for each column that
/// a table lacks.
std::vector<Comparison> read_comparisons(const Json& given, const std::vector<Truth>& truths,
                                         const std::vector<Axis>& axes, ObjectReader& reader);

/// Returns the column of time or place in the table of a truth: that of the comparison, else that
/// of the truth, else the usual one ("t" or "time"; the coordinate).
std::string over_column(const Comparison& comparison, const Truth& truth);

/// Returns the columns "<name>@<place>" of a table with their places, m, ascending.
std::vector<std::pair<double, std::size_t>> placed_columns(const CsvTable& table,
                                                           const std::string& name);

}  // namespace hyperlattice::study
