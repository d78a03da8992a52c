#include "opening.hpp"

namespace hyperlattice::equilibrium {

/// Returns the mean of value(place) over the particles of one end less that over the other's.
template <class Value>
Vec3 Opening::mean_apart(const Value& value) const {
  const auto mean = [&](std::span<const std::int64_t> places) {
    Vec3 sum;
    for (const std::int64_t place : places) sum += value(place);
    return sum / static_cast<double>(places.size());
  };
  return mean(to_) - mean(from_);
}

Opening::Opening(const StaticProblem& problem, const Ends& ends)
    : places_(problem.grid.places), from_(problem.places(ends.from)), to_(problem.places(ends.to)) {
  if (ends.direction) direction_ = direction_of(*ends.direction);
  rest_ = mean_apart([&](std::int64_t place) { return problem.position(place); });
}

double Opening::of(const Field& u) const {
  const Vec3 apart = mean_apart([&](std::int64_t place) {
    const auto at = [&](std::int64_t c) {
      return u[static_cast<std::size_t>(c * places_ + place)];
    };
    return Vec3{at(0), at(1), at(2)};
  });
  if (direction_) return dot(apart, *direction_);
  // |rest + apart| - |rest| without cancellation
  return dot(apart, 2 * rest_ + apart) / (norm(rest_ + apart) + norm(rest_));
}

}  // namespace hyperlattice::equilibrium
