// Searching the Brillouin zone: where a function of the wave vector that has the lattice's symmetry
// is largest.
#pragma once

#include <model/waves.hpp>

#include <algorithm>
#include <numbers>
#include <vector>

namespace hyperlattice {

inline constexpr double pi = std::numbers::pi;

/// The reciprocal basis in radians a spacing over 2 pi: b_i . a_j is 1 for i = j, else 0.
Basis reciprocal(const Basis& basis);

/// A turn or reflection that maps the lattice onto itself, as it acts on the phases of a wave along
/// a1, a2, a3: integers, by rows.
using PhaseMap = std::array<std::array<int, 3>, 3>;

/// Those of the 48 of a cube that map springs onto springs of their class. At least there and back,
/// q -> -q.
std::vector<PhaseMap> symmetries(const InfiniteLattice& lattice);

/// The 27 steps of -1, 0 or 1 along each axis.
const std::array<Vec3, 27>& steps_around();

/// The shortest of the vectors that give the same wave.
Vec3 in_first_zone(const Basis& basis, Vec3 q);

/// Wave vectors, radians a spacing, on a grid over the zone: of each set that symmetry makes equal,
/// one.
std::vector<Vec3> zone_grid(const InfiniteLattice& lattice, int half);

/// The wave vector where `value` is largest: the zone on a grid, then each of the best climbed by
/// halved steps.
template <class Value>
Vec3 zone_peak(const InfiniteLattice& lattice, const Value& value) {
  constexpr int half = 12;        // steps from 0 to pi along an axis
  constexpr int refined = 4;      // how many of the best are climbed
  constexpr double fine = 1e-6;   // radians, the last step
  constexpr double gain = 1e-11;  // of the largest value on the grid: less is rounding, which would
                                  // lead a climb along flat ridges for ever
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
      for (const Vec3 direction : steps_around()) {  // along edges and diagonals too: ridges run
                                                     // along the lattice's axes of symmetry
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
