#include <study/front.hpp>

#include <algorithm>
#include <tuple>

namespace hyperlattice::study {

std::vector<bool> pareto_front(const std::vector<Cost>& costs) {
  std::vector<bool> front;
  front.reserve(costs.size());
  for (const Cost& one : costs)
    front.push_back(std::none_of(costs.begin(), costs.end(), [&](const Cost& other) {
      return other.error <= one.error && other.seconds <= one.seconds &&
             (other.error < one.error || other.seconds < one.seconds);
    }));
  return front;
}

std::optional<std::size_t> cheapest(const std::vector<Cost>& costs, double target) {
  std::optional<std::size_t> best;
  for (std::size_t n = 0; n < costs.size(); ++n) {
    if (!(costs[n].error <= target)) continue;
    if (!best || std::tie(costs[n].seconds, costs[n].error) <
                     std::tie(costs[*best].seconds, costs[*best].error))
      best = n;
  }
  return best;
}

std::optional<std::size_t> most_accurate(const std::vector<Cost>& costs) {
  const auto found = std::min_element(
      costs.begin(), costs.end(), [](const Cost& a, const Cost& b) { return a.error < b.error; });
  return found == costs.end() ? std::nullopt : std::optional<std::size_t>(found - costs.begin());
}

}  // namespace hyperlattice::study
