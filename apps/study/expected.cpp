#include <study/expected.hpp>
#include <study/order.hpp>

#include <hyperlattice/tables.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hyperlattice::study {

namespace {

/// Reads numbers from the rows of a truth's table. throw_if_any throws std::runtime_error with the
/// first rows that have no number.
class RowNumbers {
 public:
  explicit RowNumbers(const Truth& truth) : truth_(truth) {}

  std::optional<double> operator()(std::size_t row, std::size_t column) {
    const std::string& cell = truth_.table->rows[row][column];
    const auto number = csv_number(cell);
    if (!number && row_ != row) {
      row_ = row;
      if (++count_ <= most_shown)
        faults_ += fmt::format("{}line {}: expected a finite number in column \"{}\", not \"{}\"",
                               faults_.empty() ? "" : "; ", truth_.table->lines[row],
                               truth_.table->columns[column], shown_cell(cell));
    }
    return number;
  }
  void throw_if_any() const {
    if (count_ == 0) return;
    const std::string more =
        count_ > most_shown ? fmt::format("; and {} such lines more", count_ - most_shown) : "";
    throw std::runtime_error(
        fmt::format("{}, {}{}", truth_.file.filename().string(), faults_, more));
  }

 private:
  static constexpr std::size_t most_shown = 5;

  const Truth& truth_;
  std::optional<std::size_t> row_;  // the latest row without a number
  std::size_t count_ = 0;
  std::string faults_;
};

/// The value of a row in a column, or, if columns at several places have it, by linear
/// interpolation between the two places around `place`.
class RowValue {
 public:
  RowValue(const Comparison& comparison, const Truth& truth, std::optional<double> place)
      : table_(*truth.table) {
    if (!place) {
      parts_ = {{table_.column(comparison.truth).value(), 1}};
      return;
    }
    const auto columns = placed_columns(table_, comparison.truth);
    const double first = columns.front().first, last = columns.back().first,
                 slack = 1e-9 * std::max(std::abs(first), std::abs(last));
    if (!(*place >= first - slack && *place <= last + slack))
      throw std::runtime_error(
          fmt::format("the truth is known from {} to {} m, not at {:g} m", first, last, *place));
    std::size_t right = columns.size() > 1 ? 1 : 0;
    while (right + 1 < columns.size() && columns[right].first < *place) ++right;
    if (right == 0) {
      parts_ = {{columns[0].second, 1}};
      return;
    }
    const double left = columns[right - 1].first,
                 weight = std::clamp((*place - left) / (columns[right].first - left), 0.0, 1.0);
    parts_ = {{columns[right - 1].second, 1 - weight}, {columns[right].second, weight}};
  }

  std::optional<double> operator()(std::size_t row, RowNumbers& numbers) const {
    double value = 0;
    for (const auto& [column, weight] : parts_) {
      const auto number = numbers(row, column);
      if (!number) return std::nullopt;
      value += weight * *number;
    }
    return value;
  }

 private:
  const CsvTable& table_;
  std::vector<std::pair<std::size_t, double>> parts_;
};

Curve table_curve(const Comparison& comparison, const Truth& truth, std::optional<double> place,
                  const std::vector<std::optional<double>>& numbers) {
  const CsvTable& table = *truth.table;
  const std::size_t over = table.column(over_column(comparison, truth)).value();
  const double over_scale = comparison.over_scale.value_or(truth.over_scale);
  const RowValue value(comparison, truth, place);
  RowNumbers number_in(truth);
  Curve curve;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    if (!passes(table, row, truth.where, numbers) || !passes(table, row, comparison.where, numbers))
      continue;
    const auto x = number_in(row, over), y = value(row, number_in);
    if (!x || !y) continue;
    curve.over.push_back(*x * over_scale);
    curve.values.push_back(*y * comparison.scale);
  }
  number_in.throw_if_any();
  if (curve.over.empty())
    throw std::runtime_error(
        fmt::format("no row of {} fits \"where\"", truth.file.filename().string()));
  return reduced(sorted(std::move(curve)), comparison.reduction);
}

/// Returns b at the points of a that are in the range of both.
Curve common_part(const Curve& a, const Curve& b) {
  Curve part;
  for (const double over : a.over)
    if (const double value = value_at(b, over); !std::isnan(value)) {
      part.over.push_back(over);
      part.values.push_back(value);
    }
  return part;
}

/// Returns a - b at the points of `where`, which must be in the range of both.
std::vector<double> difference(const Curve& where, const Curve& a, const Curve& b) {
  std::vector<double> apart;
  for (const double over : where.over) apart.push_back(value_at(a, over) - value_at(b, over));
  return apart;
}

}  // namespace

Curve true_curve(const Comparison& comparison, const Truth& truth, std::optional<double> place,
                 const std::vector<std::optional<double>>& numbers) {
  if (truth.kind == Truth::Kind::table) return table_curve(comparison, truth, place, numbers);
  return {{0}, {comparison.scale * truth.numbers.at(comparison.truth)}};
}

double order_of(const SizedCurve& coarse, const SizedCurve& middle, const SizedCurve& fine) {
  const Curve where = common_part(common_part(coarse.curve, middle.curve), fine.curve);
  const auto first = difference(where, coarse.curve, middle.curve),
             second = difference(where, middle.curve, fine.curve);
  const auto product = [](const auto& a, const auto& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
  };
  if (product(second, second) == 0)
    throw NoLimit("the finest two runs are the same, so that they show no order of convergence");
  const std::string advice =
      ", so that nothing can be extrapolated from them: refine further, or state the order";
  if (product(first, second) <= 0)
    throw NoLimit("the finest three runs lie on both sides of where they lead" + advice);
  const double fall = std::sqrt(product(first, first) / product(second, second));
  // solves (h1^p - h2^p) / (h2^p - h3^p) = ratio of the differences; the left side grows with p
  const auto ratio = [&](double p) {
    return (std::pow(coarse.size / middle.size, p) - 1) /
           (1 - std::pow(fine.size / middle.size, p));
  };
  double low = 1e-3, high = 20;
  for (int n = 0; n < 100; ++n) {
    const double p = (low + high) / 2;
    (ratio(p) < fall ? low : high) = p;
  }
  constexpr double least = 0.1;
  if (low < least) throw NoLimit("the finest three runs do not converge" + advice);
  if (low > greatest_order)
    throw NoLimit(
        fmt::format("the finest three runs show an order of {:.2f}, more than the method can have, "
                    "which is of second order{}",
                    low, advice));
  return low;
}

Curve extrapolated(const std::vector<SizedCurve>& curves, std::optional<double> order) {
  const std::size_t count = curves.size(), needed = order ? 2 : 3;
  if (count < needed)
    throw NoLimit(fmt::format("there are {} finished runs to extrapolate from, and {} are needed",
                              count, needed));
  const SizedCurve &fine = curves[count - 1], &middle = curves[count - 2];
  const double p = order ? *order : order_of(curves[count - 3], middle, fine);
  const double gain = 1 / (std::pow(middle.size / fine.size, p) - 1);
  // At the points of `middle`: in nested lattices the fine one has them too.
  Curve result = common_part(middle.curve, fine.curve);
  for (std::size_t n = 0; n < result.over.size(); ++n)
    result.values[n] += gain * (result.values[n] - value_at(middle.curve, result.over[n]));
  return result;
}

}  // namespace hyperlattice::study
