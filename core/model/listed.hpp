// The particles and springs of a listed lattice, sorted so that neighbours stand close to each
// other in memory.
#pragma once

#include <hyperlattice/lattice.hpp>

#include <cstdint>
#include <vector>

namespace hyperlattice {

/// Springs a particle, on the mean, from which a lattice in no order is stiff for certain. It takes
/// more than 6 (Maxwell 1864); between, chance decides.
inline constexpr double stiff_coordination = 7;

struct Listed {
  static constexpr std::uint64_t stretch = 64;  ///< particles; see sorted()

  std::vector<Vec3> positions;         ///< at rest, metres; in the particles' order
  std::vector<std::uint64_t> source;   ///< of each particle, its place in the lattice's own order
  std::vector<double> shares;          ///< volumes over the whole particle's; empty: all 1
  std::vector<ListedSpring> springs;   ///< a < b; by a, then b; each pair once
  std::uint32_t sample_particles = 0;  ///< of the periodic sample; 0: there is none
  double sample_volume = 0;            ///< m3
  std::vector<SampleSpring> sample;

  bool empty() const { return positions.empty(); }
};

/// Sorts the list by slabs of one spacing along z, within them by strips along y, within them by x;
/// and each stretch of particles, which lie close together, by their number of springs, so that
/// those that follow each other have about as many. Throws std::invalid_argument for what is no
/// lattice: numbers that are not finite, springs to nobody, to oneself, given twice, without
/// length, of no stiffness.
Listed sorted(const PointList& points);

/// Keeps the sample. Throws std::invalid_argument as sorted() does.
void keep_sample(Listed& listed, const PeriodicSample& sample);

}  // namespace hyperlattice
