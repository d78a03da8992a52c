// Search of the Brillouin zone for the maximum of a function of the wave vector that has the
// symmetry of the lattice.
#pragma once

#include <model/waves.hpp>

#include <algorithm>
#include <numbers>
#include <vector>

namespace hyperlattice {

inline constexpr double pi = std::numbers::pi;

/// Returns the reciprocal basis, radians per spacing, over 2 pi: b_i . a_j is 1 for i = j, else 0.
Basis reciprocal(const Basis& basis);

/// A rotation or reflection that maps the lattice onto itself, as a matrix of integers, by rows,
/// that acts on the phases of a wave along a1, a2, a3.
using PhaseMap = std::array<std::array<int, 3>, 3>;

/// Returns those of the 48 symmetries of a cube that map springs onto springs of their class. These
/// are at least the identity and q -> -q.
std::vector<PhaseMap> symmetries(const InfiniteLattice& lattice);

/// Returns the 27 steps of -1, 0 or 1 along each axis.
const std::array<Vec3, 27>& steps_around();

/// Returns the shortest of all wave vectors that describe the same wave as q.
Vec3 in_first_zone(const Basis& basis, Vec3 q);

/// Returns wave vectors, radians per spacing, on a grid over the zone with `half` steps from 0 to
/// pi: one of each set that is equal by symmetry.
std::vector<Vec3> zone_grid(const InfiniteLattice& lattice, int half);

/// Returns the wave vector with the largest `value`: evaluates a grid over the zone, then refines
/// the best points by a search with halved steps.
template <class Value>
Vec3 zone_peak(const InfiniteLattice& lattice, const Value& value) {
  constexpr int half = 12;       // steps from 0 to pi along an axis
  constexpr int refined = 4;     // number of the best points that are refined
  constexpr double fine = 1e-6;  // radians, smallest step of the search
  // Smallest gain, relative to the largest value on the grid. A smaller gain is round-off, and the
  // search would never end on flat ridges.
  constexpr double gain = 1e-11;
  struct Candidate {
    double value;
    Vec3 q;
  };
  std::vector<Candidate> best;
  double size = 0;
  const auto above = [](const Candidate& a, const Candidate& b) { return a.value > b.value; };
  for (const Vec3 q : zone_grid(lattice, half)) {
    const Candidate candidate{value(q), q};
    if (std::isfinite(candidate.value)) size = std::max(size, std::abs(candidate.value));
    if (best.size() == refined && candidate.value <= best.back().value) continue;
    best.insert(std::upper_bound(best.begin(), best.end(), candidate, above), candidate);
    if (best.size() > refined) best.pop_back();
  }
  for (Candidate& candidate : best)
    for (double step = pi / half / 2; step > fine;) {
      Candidate next = candidate;
      // Steps include edges and diagonals, because ridges run along the symmetry axes of the
      // lattice.
      for (const Vec3 direction : steps_around()) {
        const Vec3 q = candidate.q + step * direction;
        if (const double here = value(q); here > next.value) next = {here, q};
      }
      if (next.value > candidate.value + gain * size)
        candidate = next;
      else
        step /= 2;
    }
  return in_first_zone(lattice.basis, std::min_element(best.begin(), best.end(), above)->q);
}

}  // namespace hyperlattice
