// Selects the pairs of points that springs join: the shortest pairs, as many as the mean
// coordination requires. Each point is joined to its six nearest neighbours at least: otherwise a
// point at the surface may have only one or two springs and move without resistance.
#pragma once

#include <hyperlattice/neighbourhood.hpp>

#include <array>
#include <cmath>
#include <span>

namespace hyperlattice {

/// Mean number of springs of a point that a stiff body needs in three dimensions (Maxwell 1864):
/// 2 x 3, because each spring joins two points.
inline constexpr std::size_t enough_springs = 6;

/// Squared distances, m2, of each point to its `enough_springs` nearest neighbours among the given
/// pairs, ascending. The list of a point with fewer neighbours ends with infinity.
class NearestOfEach {
 public:
  NearestOfEach(std::size_t points, std::span<const NearPair> pairs) : squares_(points) {
    for (auto& nearest : squares_) nearest.fill(infinity);
    for (const NearPair& pair : pairs) {
      take(squares_[pair.a], dot(pair.rest, pair.rest));
      take(squares_[pair.b], dot(pair.rest, pair.rest));
    }
  }
  /// Returns whether one end of the pair is among the `few` nearest neighbours of the other.
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

/// Returns candidates for springs: at least the `wanted` shortest pairs, and the pairs of each
/// point with its `enough_springs` nearest neighbours at any distance. `spacing`: about the
/// distance of neighbours, m. Points lie in the box from `low` to `high`, m.
inline std::vector<NearPair> pairs_to_choose_from(std::span<const Vec3> points, Vec3 low, Vec3 high,
                                                  double spacing, std::size_t wanted) {
  const double coordination = 2 * static_cast<double>(wanted) / static_cast<double>(points.size());
  double reach = 1.2 * spacing *
                 std::cbrt(3 * (coordination + 1) /
                           (4 * 3.141592653589793));  // of an infinite body, times 1.2
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

/// The springs of a body, and the rule that joins another body in the same way.
struct Joined {
  std::vector<NearPair> springs;
  double reach = 0;     ///< length up to which all pairs are joined, m
  std::size_t few = 0;  ///< number of nearest neighbours to which each point is joined at least
};

/// Joins points with `wanted` springs from the given pairs, or with all pairs if there are fewer.
/// The number of nearest neighbours (`Joined::few`) is six, or less if six need more springs than
/// `wanted`.
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

/// Joins points by the rule of another body: its reach and its number of nearest neighbours.
inline std::vector<NearPair> joined_alike(std::size_t points, std::vector<NearPair> pairs,
                                          const Joined& like) {
  const NearestOfEach nearest(points, pairs);
  std::erase_if(pairs, [&](const NearPair& pair) {
    return norm(pair.rest) > like.reach && !nearest.joins(pair, like.few);
  });
  return pairs;
}

}  // namespace hyperlattice
