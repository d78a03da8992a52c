#include <study/order.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

namespace hyperlattice::study {

namespace {

std::string doubt_of(const std::vector<double>& pairs) {
  constexpr double most_scatter = 1.5;
  const auto [least, greatest] = std::minmax_element(pairs.begin(), pairs.end());
  if (*greatest > greatest_order)
    return fmt::format(
        "an order of {:.2f} is more than the method can have, which is of second order: errors "
        "cancel, or the sizes are too coarse",
        *greatest);
  if (*least <= 0) return "the error does not fall at every step";
  if (*greatest - *least > most_scatter)
    return fmt::format("from step to step it scatters, from {:.2f} to {:.2f}", *least, *greatest);
  return "";
}

}  // namespace

std::optional<ObservedOrder> observed_order(std::vector<SizedError> errors) {
  std::erase_if(errors, [](const SizedError& e) {
    return !(e.size > 0 && e.error > 0 && std::isfinite(e.error));
  });
  std::stable_sort(errors.begin(), errors.end(),
                   [](const SizedError& a, const SizedError& b) { return a.size > b.size; });
  errors.erase(
      std::unique(errors.begin(), errors.end(),
                  [](const SizedError& a, const SizedError& b) { return a.size == b.size; }),
      errors.end());
  if (errors.size() < 2) return std::nullopt;

  ObservedOrder found;
  double mean_x = 0, mean_y = 0;
  for (const SizedError& e : errors) {
    mean_x += std::log(e.size) / static_cast<double>(errors.size());
    mean_y += std::log(e.error) / static_cast<double>(errors.size());
  }
  double xx = 0, xy = 0;
  for (const SizedError& e : errors) {
    const double x = std::log(e.size) - mean_x;
    xx += x * x;
    xy += x * (std::log(e.error) - mean_y);
  }
  found.order = xy / xx;
  for (std::size_t n = 1; n < errors.size(); ++n)
    found.pairs.push_back(std::log(errors[n - 1].error / errors[n].error) /
                          std::log(errors[n - 1].size / errors[n].size));
  found.errors = std::move(errors);
  found.doubt = doubt_of(found.pairs);
  return found;
}

std::optional<double> size_for(const ObservedOrder& order, double target) {
  constexpr double least = 0.1;  // a smaller order does not allow an extrapolation
  if (!order.doubt.empty() || order.order < least) return std::nullopt;
  const SizedError& finest = order.errors.back();
  return finest.size * std::pow(target / finest.error, 1 / order.order);
}

}  // namespace hyperlattice::study
