// Error against run time: who is on the Pareto front, and who is the cheapest that is good enough.
#pragma once

#include <optional>
#include <vector>

namespace hyperlattice::study {

struct Cost {
  double error = 0, seconds = 0;
};

/// Of each, whether no other is at least as good in both and better in one.
std::vector<bool> pareto_front(const std::vector<Cost>& costs);

/// The quickest with an error of at most `target`; of two equally quick the more accurate one.
std::optional<std::size_t> cheapest(const std::vector<Cost>& costs, double target);

/// The most accurate one; nothing if there is none at all.
std::optional<std::size_t> most_accurate(const std::vector<Cost>& costs);

}  // namespace hyperlattice::study
