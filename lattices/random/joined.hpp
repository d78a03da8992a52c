// Which points springs join: the shortest pairs, as many as a mean coordination asks for, but each
// point to its nearest few at least. Without these a point at the surface may hang on one spring or
// two, and swing.
#pragma once

#include <hyperlattice/neighbourhood.hpp>

#include <array>
#include <cmath>
#include <span>

namespace hyperlattice {

/// As many springs as three coordinates need on the mean of a stiff body (Maxwell 1864): each joins
/// two points.
inline constexpr std::size_t enough_springs = 6;

/// Squared distances of each point to its nearest few among pairs, ascending; infinite beyond those
/// that it has.
class NearestOfEach {
 public:
  NearestOfEach(std::size_t points, std::span<const NearPair> pairs) : squares_(points) {
    for (auto& nearest : squares_) nearest.fill(infinity);
    for (const NearPair& pair : pairs) {
      take(squares_[pair.a], dot(pair.rest, pair.rest));
      take(squares_[pair.b], dot(pair.rest, pair.rest));
    }
  }
  /// Whether one end counts the other among its nearest `few`.
  bool joins(const NearPair& pair, std::size_t few) const {
    const double square = dot(pair.rest, pair.rest);
    return few > 0 && (square <= squares_[pair.a][few - 1] || square <= squares_[pair.b][few - 1]);
  }
  bool has_enough(std::uint32_t point) const { return squares_[point].back() < infinity; }
  std::size_t points() const { return squares_.size(); }

 private:
  using Nearest = std::array<double, enough_springs>;
  static void take(Nearest& nearest, double square) {
    if (!(square < nearest.back())) return;
    nearest.back() = square;
    for (std::size_t n = enough_springs - 1; n > 0 && nearest[n] < nearest[n - 1]; --n)
      std::swap(nearest[n], nearest[n - 1]);
  }
  std::vector<Nearest> squares_;
};

/// At least the `wanted` shortest pairs of points `spacing` apart, and those that give each point
/// its nearest few, however far away these are.
inline std::vector<NearPair> pairs_to_choose_from(std::span<const Vec3> points, Vec3 low, Vec3 high,
                                                  double spacing, std::size_t wanted) {
  const double coordination = 2 * static_cast<double>(wanted) / static_cast<double>(points.size());
  double reach = 1.2 * spacing *
                 std::cbrt(3 * (coordination + 1) /
                           (4 * 3.141592653589793));  // of an endless body, and some more
  std::vector<NearPair> pairs = near_pairs(points, low, high, reach);
  while (pairs.size() < wanted) pairs = near_pairs(points, low, high, reach *= 1.3);
  if (points.size() <= enough_springs) return pairs;
  for (double wide = 1.5 * reach;; wide *= 1.5) {
    const NearestOfEach nearest(points.size(), pairs);
    std::vector<std::uint32_t> lonely;
    for (std::uint32_t p = 0; p < points.size(); ++p)
      if (!nearest.has_enough(p)) lonely.push_back(p);
    if (lonely.empty()) return pairs;
    std::vector<bool> is_lonely(points.size(), false);
    for (const std::uint32_t p : lonely) is_lonely[p] = true;
    Neighbourhood all(low, high, wide, points.size());
    for (const Vec3 point : points) all.add(point);
    for (const std::uint32_t p : lonely)
      all.for_near(points[p], [&](std::uint32_t other, Vec3 away) {
        const bool is_known = dot(away, away) <= reach * reach,
                   meets_again = is_lonely[other] && other < p;
        if (other != p && !is_known && !meets_again) pairs.push_back({p, other, away});
      });
    reach = wide;
  }
}

/// The springs of a body, and how to join another one in the same way.
struct Joined {
  std::vector<NearPair> springs;
  double reach = 0;     ///< m, up to which all pairs are joined
  std::size_t few = 0;  ///< each point has springs to its nearest few at least
};

/// Joins points with the `wanted` springs of these pairs, or all if there are no more. Fewer than
/// six nearest ones are asked for where they would be too many.
inline Joined joined_by_number(std::size_t points, std::vector<NearPair> pairs,
                               std::size_t wanted) {
  const NearestOfEach nearest(points, pairs);
  Joined found;
  for (found.few = enough_springs; found.few > 0; --found.few)
    if (static_cast<std::size_t>(std::count_if(
            pairs.begin(), pairs.end(),
            [&](const NearPair& pair) { return nearest.joins(pair, found.few); })) <= wanted)
      break;
  const auto others = std::partition(pairs.begin(), pairs.end(), [&](const NearPair& pair) {
    return nearest.joins(pair, found.few);
  });
  std::vector<NearPair> more =
      shortest({others, pairs.end()},
               std::min(wanted, pairs.size()) - static_cast<std::size_t>(others - pairs.begin()));
  for (const NearPair& pair : more) found.reach = std::max(found.reach, norm(pair.rest));
  found.springs.assign(pairs.begin(), others);
  found.springs.insert(found.springs.end(), more.begin(), more.end());
  return found;
}

/// Joins points as another body's are.
inline std::vector<NearPair> joined_alike(std::size_t points, std::vector<NearPair> pairs,
                                          const Joined& like) {
  const NearestOfEach nearest(points, pairs);
  std::erase_if(pairs, [&](const NearPair& pair) {
    return norm(pair.rest) > like.reach && !nearest.joins(pair, like.few);
  });
  return pairs;
}

}  // namespace hyperlattice
