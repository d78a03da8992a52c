#include <study/front.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
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

std::optional<double> seconds_for(const std::vector<Cost>& costs, double error) {
  std::vector<Cost> front;  // from the quickest to the most accurate
  const std::vector<bool> on_front = pareto_front(costs);
  for (std::size_t n = 0; n < costs.size(); ++n)
    if (on_front[n]) front.push_back(costs[n]);
  std::sort(front.begin(), front.end(),
            [](const Cost& a, const Cost& b) { return a.seconds < b.seconds; });
  const auto reached = std::find_if(front.begin(), front.end(),
                                    [&](const Cost& cost) { return cost.error <= error; });
  if (reached == front.end()) return std::nullopt;
  if (reached == front.begin() || !(reached->error > 0)) return reached->seconds;
  const Cost& before = *std::prev(reached);
  const double way = std::log(before.error / error) / std::log(before.error / reached->error);
  return before.seconds * std::pow(reached->seconds / before.seconds, way);
}

std::optional<std::size_t> most_accurate(const std::vector<Cost>& costs) {
  const auto found = std::min_element(
      costs.begin(), costs.end(), [](const Cost& a, const Cost& b) { return a.error < b.error; });
  return found == costs.end() ? std::nullopt : std::optional<std::size_t>(found - costs.begin());
}

}  // namespace hyperlattice::study
