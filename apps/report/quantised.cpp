#include <report/quantised.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hyperlattice::report {

Json QuantisedNumbers::add(std::span<const double> values, std::size_t components, std::size_t part,
                           const Json& before) {
  constexpr double steps = 65534;
  constexpr std::uint16_t no_number = 65535;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t n = part; n < values.size(); n += components)
    if (std::isfinite(values[n])) {
      low = std::min(low, values[n]);
      high = std::max(high, values[n]);
    }
  const std::size_t start = numbers_.size();
  for (std::size_t n = part; n < values.size(); n += components) {
    const double share = high > low ? (values[n] - low) / (high - low) : 0;
    numbers_.push_back(std::isfinite(values[n])
                           ? static_cast<std::uint16_t>(std::lround(share * steps))
                           : no_number);
  }
  Json place = {{"min", nullptr}, {"max", nullptr}, {"at", start}};
  if (low <= high) {
    place["min"] = low;
    place["max"] = high;
  }
  if (before.is_object() && before["min"] == place["min"] && before["max"] == place["max"]) {
    const auto added = numbers_.begin() + static_cast<std::ptrdiff_t>(start);
    const auto earlier = numbers_.begin() + before["at"].get<std::ptrdiff_t>();
    if (std::equal(added, numbers_.end(), earlier)) {
      numbers_.resize(start);
      return before;
    }
  }
  return place;
}

std::string QuantisedNumbers::bytes() const {
  std::string out;
  out.reserve(2 * numbers_.size());
  for (const std::uint16_t number : numbers_) {
    out += static_cast<char>(number & 0xff);
    out += static_cast<char>(number >> 8);
  }
  return out;
}

}  // namespace hyperlattice::report
