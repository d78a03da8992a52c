#include <report/thin.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hyperlattice::report {

namespace {

/// Appends the points that represent the column [begin, end).
void keep_column(std::span<const double> y, std::size_t begin, std::size_t end,
                 std::vector<std::size_t>& kept) {
  std::vector<std::size_t> some{begin, end - 1};
  std::size_t least = end, greatest = end, gap = end;
  for (std::size_t n = begin; n < end; ++n) {
    if (!std::isfinite(y[n])) {
      gap = n;
      continue;
    }
    if (least == end || y[n] < y[least]) least = n;
    if (greatest == end || y[n] > y[greatest]) greatest = n;
  }
  for (const std::size_t n : {least, greatest, gap})
    if (n != end) some.push_back(n);
  std::sort(some.begin(), some.end());
  some.erase(std::unique(some.begin(), some.end()), some.end());
  kept.insert(kept.end(), some.begin(), some.end());
}

}  // namespace

std::vector<std::size_t> thinned(std::span<const double> x, std::span<const double> y,
                                 std::size_t columns) {
  const std::size_t count = std::min(x.size(), y.size());
  const bool is_finite =
      std::all_of(x.begin(), x.end(), [](double value) { return std::isfinite(value); });
  if (count <= 4 * columns || !is_finite || !std::is_sorted(x.begin(), x.end()) ||
      !(x.back() > x.front())) {
    std::vector<std::size_t> all(count);
    std::iota(all.begin(), all.end(), std::size_t{0});
    return all;
  }
  const auto column = [&](std::size_t n) {
    const double fraction = (x[n] - x.front()) / (x.back() - x.front());
    return std::min(columns - 1, static_cast<std::size_t>(fraction * static_cast<double>(columns)));
  };
  std::vector<std::size_t> kept;
  for (std::size_t begin = 0, end = 0; begin < count; begin = end) {
    for (end = begin + 1; end < count && column(end) == column(begin);) ++end;
    keep_column(y, begin, end, kept);
  }
  return kept;
}

}  // namespace hyperlattice::report
