// Error against run time: the Pareto front and the cheapest run that is accurate enough.
#pragma once

#include <optional>
#include <vector>

namespace hyperlattice::study {

/// The error (a fraction) and the run time, s, of a run.
struct Cost {
  double error = 0, seconds = 0;
};

/// Marks the Pareto-optimal points: no other point is at least as good in both numbers and better
/// in one.
std::vector<bool> pareto_front(const std::vector<Cost>& costs);

/// Returns the index of the fastest with an error of at most `target`, of two equally fast ones the
/// more accurate; nothing if there is none.
std::optional<std::size_t> cheapest(const std::vector<Cost>& costs, double target);

/// Returns the run time that an error takes, by a power law between two neighbouring points of the
/// Pareto front; if all points are at least as accurate, the shortest run time; nothing if none is.
std::optional<double> seconds_for(const std::vector<Cost>& costs, double error);

/// Returns the index of the most accurate; nothing if `costs` is empty.
std::optional<std::size_t> most_accurate(const std::vector<Cost>& costs);

}  // namespace hyperlattice::study
