#include <report/ticks.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

namespace hyperlattice::report {

std::vector<Tick> round_ticks(double low, double high, int most, bool whole) {
  if (!(low < high) || !std::isfinite(high - low) || most < 1) return {};
  constexpr double rounding = 1e-9;
  const double raw = std::max((high - low) / most, whole ? 1.0 : 0.0);
  int power = static_cast<int>(std::floor(std::log10(raw)));
  int multiple = 1;
  for (const int m : {1, 2, 5, 10}) {
    multiple = m;
    if (m * std::pow(10.0, power) >= raw * (1 - rounding)) break;
  }
  if (multiple == 10) {
    multiple = 1;
    ++power;
  }
  const double step = multiple * std::pow(10.0, power);
  const int decimals = std::clamp(-power, 0, 15);
  std::vector<Tick> ticks;
  const double last = std::floor(high / step + rounding);
  for (double n = std::ceil(low / step - rounding); n <= last; n += 1) {
    const double value = n == 0 ? 0 : n * step;  // avoids "-0"
    ticks.push_back({value, fmt::format("{:.{}f}", value, decimals)});
  }
  return ticks;
}

}  // namespace hyperlattice::report
