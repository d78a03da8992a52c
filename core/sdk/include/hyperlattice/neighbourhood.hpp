// Finds points within a distance, with points sorted into the cells of a coarse grid. For lattices
// that join particles by their distance.
#pragma once

#include <hyperlattice/plain.hpp>

#include <algorithm>
#include <concepts>
#include <stdexcept>
#include <vector>

namespace hyperlattice {

/// Points, and a grid of cubes that finds those within a distance of a place.
class Neighbourhood {
 public:
  /// Prepares for about `points` points between `low` and `high` and distances up to `reach`, m.
  /// `periodic`: the box repeats in all directions. Throws std::invalid_argument if a periodic box
  /// is narrower than three times `reach`.
  Neighbourhood(Vec3 low, Vec3 high, double reach, std::size_t points, bool periodic = false)
      : low_(low), size_(high - low), reach_(reach), periodic_(periodic) {
    const double most_along = 1e6, most_cells = 8 * static_cast<double>(points) + 4096;
    double count[3];
    for (int axis = 0; axis < 3; ++axis) {
      count[axis] = std::clamp(std::floor(size_[axis] / reach), 1.0, most_along);
      if (periodic && count[axis] < 3)
        throw std::invalid_argument(
            "a periodic box of points must be at least three times as wide as their neighbours' "
            "distance");
    }
    while (count[0] * count[1] * count[2] >
           most_cells) {  // cells may be wider than `reach`, never narrower
      double& largest = *std::max_element(count, count + 3);
      largest = std::floor(largest / 2);
    }
    for (int axis = 0; axis < 3; ++axis) count_[axis] = static_cast<std::int64_t>(count[axis]);
    head_.assign(static_cast<std::size_t>(count[0] * count[1] * count[2]), none);
  }

  /// The fourth argument was `periodic` in older versions. A call that still passes a bool must not
  /// compile: true would be read as a number of points.
  Neighbourhood(Vec3, Vec3, double, std::same_as<bool> auto) = delete;

  /// Adds a point. Points are numbered in the order of the calls.
  void add(Vec3 point) {
    std::uint32_t& head = head_[cell(step(point, 0), step(point, 1), step(point, 2))];
    next_.push_back(head);
    head = static_cast<std::uint32_t>(points_.size());
    points_.push_back(point);
  }
  const std::vector<Vec3>& points() const { return points_; }

  /// Calls visit(number, vector to the point, m) for every added point that is no farther than
  /// `reach` from `point`.
  template <class Visit>
  void for_near(Vec3 point, const Visit& visit) const {
    const std::int64_t i = step(point, 0), j = step(point, 1), k = step(point, 2);
    for (std::int64_t z = k - 1; z <= k + 1; ++z)
      for (std::int64_t y = j - 1; y <= j + 1; ++y)
        for (std::int64_t x = i - 1; x <= i + 1; ++x) {
          if (!periodic_ && (!inside(x, 0) || !inside(y, 1) || !inside(z, 2))) continue;
          for (std::uint32_t n = head_[cell(wrapped(x, 0), wrapped(y, 1), wrapped(z, 2))];
               n != none; n = next_[n]) {
            const Vec3 away = shortest(points_[n] - point);
            if (dot(away, away) <= reach_ * reach_) visit(n, away);
          }
        }
  }

 private:
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  std::int64_t step(Vec3 point, int axis) const {
    const double size = size_[axis], along = point[axis] - low_[axis],
                 cells = size > 0 ? along / size * static_cast<double>(count_[axis]) : 0;
    return std::clamp(static_cast<std::int64_t>(std::floor(cells)), std::int64_t{0},
                      count_[axis] - 1);
  }
  bool inside(std::int64_t at, int axis) const { return at >= 0 && at < count_[axis]; }
  std::int64_t wrapped(std::int64_t at, int axis) const {
    return at < 0 ? at + count_[axis] : at >= count_[axis] ? at - count_[axis] : at;
  }
  std::size_t cell(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return static_cast<std::size_t>((k * count_[1] + j) * count_[0] + i);
  }
  Vec3 shortest(Vec3 away) const {
    if (!periodic_) return away;
    const auto image = [](double d, double period) { return d - period * std::round(d / period); };
    return {image(away.x, size_.x), image(away.y, size_.y), image(away.z, size_.z)};
  }

  Vec3 low_, size_;
  double reach_;
  bool periodic_;
  std::int64_t count_[3];
  std::vector<Vec3> points_;
  std::vector<std::uint32_t> head_, next_;
};

/// A pair of neighbouring points.
struct NearPair {
  std::uint32_t a = 0, b = 0;
  Vec3 rest;  ///< from a to b, metres
};

/// Returns all pairs of points no farther apart than `reach`, m, each once. `low`, `high`, `reach`
/// and `periodic` are as in Neighbourhood's constructor.
inline std::vector<NearPair> near_pairs(std::span<const Vec3> points, Vec3 low, Vec3 high,
                                        double reach, bool periodic = false) {
  Neighbourhood near(low, high, reach, points.size(), periodic);
  std::vector<NearPair> pairs;
  for (std::uint32_t b = 0; b < points.size(); ++b) {
    near.for_near(points[b], [&](std::uint32_t a, Vec3 away) { pairs.push_back({a, b, -away}); });
    near.add(points[b]);
  }
  return pairs;
}

/// Returns the `count` shortest pairs, in no order; all pairs if there are no more.
inline std::vector<NearPair> shortest(std::vector<NearPair> pairs, std::size_t count) {
  if (count >= pairs.size()) return pairs;
  const auto shorter = [](const NearPair& p, const NearPair& q) {
    return dot(p.rest, p.rest) < dot(q.rest, q.rest);
  };
  std::nth_element(pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(count), pairs.end(),
                   shorter);
  pairs.resize(count);
  return pairs;
}

/// Returns the shortest pairs of points, as many as give the mean number of neighbours
/// `coordination`. Throws std::invalid_argument if there are not enough pairs.
inline std::vector<NearPair> pairs_with_coordination(std::span<const Vec3> points, Vec3 low,
                                                     Vec3 high, double spacing,
                                                     double coordination) {
  const auto wanted =
      static_cast<std::size_t>(std::llround(coordination * static_cast<double>(points.size()) / 2));
  if (points.size() < 2 || wanted > points.size() * (points.size() - 1) / 2)
    throw std::invalid_argument("coordination that this number of particles can have");
  double reach = 1.2 * spacing *
                 std::cbrt(3 * (coordination + 1) /
                           (4 * 3.141592653589793));  // of an infinite body, and a margin
  for (;; reach *= 1.3) {
    std::vector<NearPair> pairs = near_pairs(points, low, high, reach);
    if (pairs.size() >= wanted) return shortest(std::move(pairs), wanted);
  }
}

}  // namespace hyperlattice
