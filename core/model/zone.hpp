// Searching the Brillouin zone: where a function of the wave vector that has the lattice's symmetry is largest.
#pragma once

#include <hyperlattice/kernels/request.hpp>
#include <hyperlattice/load.hpp>

#include <algorithm>
#include <numbers>
#include <vector>

namespace hyperlattice {

inline constexpr double pi = std::numbers::pi;

/// Whether the neighbours, both ways, go over into themselves when axes are swapped or reversed: then a 48th of the zone is all of it.
inline bool has_cubic_symmetry(std::span<const NeighbourGeometry> neighbours) {
  const auto among = [neighbours](const Neighbour& wanted) {
    return std::any_of(neighbours.begin(), neighbours.end(), [&](const NeighbourGeometry& n) {
      const Neighbour& s = n.site;
      return s.spring_class == wanted.spring_class &&
             ((s.dx == wanted.dx && s.dy == wanted.dy && s.dz == wanted.dz) || (s.dx == -wanted.dx && s.dy == -wanted.dy && s.dz == -wanted.dz));
    });
  };
  return std::all_of(neighbours.begin(), neighbours.end(), [&](const NeighbourGeometry& n) {  // by three operations that generate all 48
    const auto [x, y, z, spring_class] = n.site;
    return among({-x, y, z, spring_class}) && among({y, x, z, spring_class}) && among({x, z, y, spring_class});
  });
}

/// The wave vector where `value` is largest: the zone on a grid, then each of the best climbed by halved steps.
template <class Value>
Vec3 zone_peak(std::span<const NeighbourGeometry> neighbours, const Value& value) {
  constexpr int half = 12;       // steps from 0 to pi along an axis
  constexpr int refined = 6;     // how many of the best are climbed
  constexpr double fine = 1e-6;  // radians, the last step
  struct Candidate {
    double value;
    Vec3 q;
  };
  std::vector<Candidate> best;
  const auto above = [](const Candidate& a, const Candidate& b) { return a.value > b.value; };
  const bool cubic = has_cubic_symmetry(neighbours);
  constexpr double spacing = pi / half;
  for (int i = 0; i <= half; ++i)  // the other half of the zone is its mirror image, q -> -q
    for (int j = cubic ? 0 : 1 - half; j <= (cubic ? i : half); ++j)
      for (int k = cubic ? 0 : 1 - half; k <= (cubic ? j : half); ++k) {
        const Vec3 q{spacing * i, spacing * j, spacing * k};
        const Candidate candidate{value(q), q};
        if (best.size() == refined && candidate.value <= best.back().value) continue;
        best.insert(std::upper_bound(best.begin(), best.end(), candidate, above), candidate);
        if (best.size() > refined) best.pop_back();
      }
  for (Candidate& candidate : best)
    for (double step = spacing / 2; step > fine;) {
      Candidate next = candidate;
      for (const Vec3 direction : face_normals) {
        const Vec3 q = candidate.q + step * direction;
        if (const double here = value(q); here > next.value) next = {here, q};
      }
      if (next.value > candidate.value)
        candidate = next;
      else
        step /= 2;
    }
  return std::min_element(best.begin(), best.end(), above)->q;
}

}  // namespace hyperlattice
