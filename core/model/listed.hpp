// Particles and springs of a listed lattice, sorted so that neighbours are close to each other in
// memory.
#pragma once

#include <hyperlattice/lattice.hpp>

#include <cstdint>
#include <vector>

namespace hyperlattice {

/// The mean number of springs of a particle from which a random lattice is certainly stiff. More
/// than 6 are necessary (Maxwell 1864); between 6 and this number chance decides.
inline constexpr double stiff_coordination = 7;

struct Listed {
  static constexpr std::uint64_t stretch = 64;  ///< group size, particles; see sorted()

  std::vector<Vec3> positions;        ///< positions at rest, m, in the order of the particles
  std::vector<std::uint64_t> source;  ///< for each particle its index in the lattice's own order
  /// Volume of each particle over that of a whole particle; empty: all 1.
  std::vector<double> shares;
  std::vector<ListedSpring> springs;   ///< a < b; sorted by a, then b; each pair once
  std::vector<ListedSpring> cut;       ///< those that were cut from the start, in the same order
  std::uint32_t sample_particles = 0;  ///< number of particles of the periodic sample; 0: no sample
  double sample_volume = 0;            ///< m3
  std::vector<SampleSpring> sample;

  bool empty() const { return positions.empty(); }
};

/// Sorts the list by slabs of one spacing along z, within them by strips along y, within them by x.
/// Then sorts each group of `stretch` particles, which are close together, by number of springs, so
/// that successive particles have about the same number. Throws std::invalid_argument if the list
/// is no lattice: numbers that are not finite; springs to a particle that does not exist, to the
/// particle itself, given twice, without length or without stiffness.
Listed sorted(const PointList& points);

/// Stores the sample. Throws std::invalid_argument if it has no particles or no volume, or a spring
/// without length or to a particle that does not exist.
void keep_sample(Listed& listed, const PeriodicSample& sample);

}  // namespace hyperlattice
