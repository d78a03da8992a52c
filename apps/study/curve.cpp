#include <study/curve.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace hyperlattice::study {

namespace {

/// Returns the integral over the range of the curve by the trapezoidal rule.
double integral(const Curve& curve) {
  double sum = 0;
  for (std::size_t n = 1; n < curve.over.size(); ++n)
    sum += (curve.over[n] - curve.over[n - 1]) * (curve.values[n] + curve.values[n - 1]) / 2;
  return sum;
}

}  // namespace

Curve sorted(Curve curve) {
  std::vector<std::size_t> order(curve.over.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return curve.over[a] < curve.over[b]; });
  Curve result;
  double count = 0;
  for (const std::size_t n : order) {
    if (!result.over.empty() && result.over.back() == curve.over[n]) {
      count += 1;
      result.values.back() += (curve.values[n] - result.values.back()) / count;
    } else {
      result.over.push_back(curve.over[n]);
      result.values.push_back(curve.values[n]);
      count = 1;
    }
  }
  return result;
}

double value_at(const Curve& curve, double over) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN(), rounding = 1e-9;
  if (curve.over.empty()) return nothing;
  const double first = curve.over.front(), last = curve.over.back();
  const double slack = rounding * std::max({last - first, std::abs(first), std::abs(last)});
  if (!(over >= first - slack && over <= last + slack)) return nothing;
  const auto right = std::lower_bound(curve.over.begin(), curve.over.end(), over);
  if (right == curve.over.begin()) return curve.values.front();
  if (right == curve.over.end()) return curve.values.back();
  const auto n = static_cast<std::size_t>(right - curve.over.begin());
  const double weight = (over - curve.over[n - 1]) / (curve.over[n] - curve.over[n - 1]);
  return (1 - weight) * curve.values[n - 1] + weight * curve.values[n];
}

Curve reduced(Curve curve, Reduction reduction) {
  if (curve.values.empty()) return curve;
  const auto& values = curve.values;
  switch (reduction) {
    case Reduction::none:
      return curve;
    case Reduction::last:
      return {{0}, {values.back()}};
    case Reduction::largest:
      return {{0}, {*std::max_element(values.begin(), values.end())}};
    case Reduction::least:
      return {{0}, {*std::min_element(values.begin(), values.end())}};
    case Reduction::mean: {
      const double range = curve.over.back() - curve.over.front();
      return {{0}, {range > 0 ? integral(curve) / range : values.front()}};
    }
  }
  return curve;
}

double Distance::relative(Norm norm) const {
  if (size == 0) throw std::runtime_error("the truth is zero, so that there is no relative error");
  return norm == Norm::relative_l2 || norm == Norm::together_l2 ? std::sqrt(difference / size)
                                                                : difference / size;
}

Distance distance(const Curve& observed, const Curve& truth, Norm norm) {
  double difference = 0, size = 0;
  std::size_t common = 0;
  for (std::size_t n = 0; n < truth.over.size(); ++n) {
    const double value = value_at(observed, truth.over[n]);
    if (std::isnan(value)) continue;
    ++common;
    const double apart = std::abs(value - truth.values[n]), true_size = std::abs(truth.values[n]);
    switch (norm) {
      case Norm::relative_l2:
      case Norm::together_l2:
        difference += apart * apart;
        size += true_size * true_size;
        break;
      case Norm::relative_max:
        difference = std::max(difference, apart);
        size = std::max(size, true_size);
        break;
      case Norm::relative_end:
        difference = apart;
        size = std::max(size, true_size);
        break;
    }
  }
  if (common == 0) {
    const auto range = [](const Curve& curve) {
      return curve.over.empty()
                 ? std::string("nowhere")
                 : fmt::format("from {:g} to {:g}", curve.over.front(), curve.over.back());
    };
    throw std::runtime_error(fmt::format(
        "the run and the truth have nothing in common: the run is known {}, the truth {}",
        range(observed), range(truth)));
  }
  return {difference, size};
}

}  // namespace hyperlattice::study
