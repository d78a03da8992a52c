#include "failure.hpp"
#include "words.hpp"

namespace hyperlattice::statics {

namespace {

/// Where a motion is largest, along what, and how much of the body takes part in it.
std::string motion_text(const StaticProblem& problem, const Field& motion) {
  const StaticGrid& grid = problem.grid;
  const auto component = [&](std::int64_t c, std::int64_t p) { return motion[static_cast<std::size_t>(c * grid.places + p)]; };
  const auto along = [&](std::int64_t p) { return Vec3{component(0, p), component(1, p), component(2, p)}; };
  double largest = 0, height = 0;
  std::int64_t place = grid.origin;
  for (std::int64_t p = 0; p < grid.places; ++p) {
    if (grid.components == 4) height = std::max(height, std::abs(component(3, p)));
    if (norm(along(p)) <= largest) continue;
    largest = norm(along(p));
    place = p;
  }
  if (largest <= 0.1 * height) return "that motion is one of the fourth dimension, of the membranes";
  std::uint64_t all = 0, many = 0;
  for (std::int64_t p = 0; p < grid.places; ++p) {
    if (grid.free[p] != 0) ++all;
    if (norm(along(p)) >= 0.5 * largest) ++many;
  }
  return "that motion is largest at " + short_vector(problem.position(place), 6) + " m, along " + direction_text(along(place)) + ", and " +
         short_number(100 * static_cast<double>(many) / static_cast<double>(all), 2) + "% of the particles that are free move at least half as far";
}

}  // namespace

std::string failure_text(const StaticProblem& problem, double share, double time, const Found& found) {
  std::string text = "the body finds no state of rest ";
  text += share == 0 ? "under its loads" : "beyond " + short_number(100 * share) + "% of the load, at " + short_number(time) + " s";
  text += ": " + found.why;
  if (found.direction.empty() || found.rigid) return text;
  return text + "; " + motion_text(problem, found.direction) +
         (found.buckles ? ". There the body buckles."
          : share == 0  ? ". Supports may be missing, or parts not joined."
                        : ". The body may buckle there.");
}

}  // namespace hyperlattice::statics
