#include <base/ticks.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

namespace hyperlattice {

namespace {

constexpr double rounding = 1e-9;

/// A step of `multiple` (1, 2 or 5) times 10^power.
struct RoundStep {
  int multiple = 1, power = 0;
  double value() const { return multiple * std::pow(10.0, power); }
};

/// Returns the smallest round step of at least `least`.
RoundStep step_from(double least) {
  const int power = static_cast<int>(std::floor(std::log10(least)));
  for (const int multiple : {1, 2, 5})
    if (multiple * std::pow(10.0, power) >= least * (1 - rounding)) return {multiple, power};
  return {1, power + 1};
}

}  // namespace

double round_step(double range, int most) {
  return range > 0 && std::isfinite(range) ? step_from(range / most).value() : 1;
}

std::vector<Tick> round_ticks(double low, double high, int most, bool whole) {
  if (!(low < high) || !std::isfinite(high - low) || most < 1) return {};
  const RoundStep round = step_from(std::max((high - low) / most, whole ? 1.0 : 0.0));
  const double step = round.value();
  const int decimals = std::clamp(-round.power, 0, 15);
  std::vector<Tick> ticks;
  const double last = std::floor(high / step + rounding);
  for (double n = std::ceil(low / step - rounding); n <= last; n += 1) {
    const double value = n == 0 ? 0 : n * step;  // avoids "-0"
    ticks.push_back({value, fmt::format("{:.{}f}", value, decimals)});
  }
  return ticks;
}

}  // namespace hyperlattice
