// One block of the state: its arrays, its supports, and the breakages of the step that is under
// way.
#pragma once

#include <state/layout.hpp>
#include <state/numbers.hpp>

#include <cstdint>
#include <vector>

namespace hyperlattice {

inline constexpr std::uint32_t not_watched = ~std::uint32_t{0}, no_load = ~std::uint32_t{0};

/// A load's part in a support.
struct Contribution {
  std::uint32_t support = 0, load = 0;
  Particle particle = 0;
  std::uint32_t watched = not_watched;  ///< which of the load's watched particles: the force is its
                                        ///< answer, not an amplitude
  Vec3 force, displacement, velocity;   ///< amplitudes
  Axes displaced = 0, driven = 0;
  Vec3 goal;          ///< m, the displacement along driven axes where time is held
  double factor = 0;  ///< of the present step
  double work = 0;    ///< of the force since the start, J
  double held_work =
      0;  ///< its part along prescribed axes, which whatever holds the particle takes back, J
};

/// What a block of a listed body has besides; see ListedSlots.
struct ListedArrays {
  AlignedArray<std::uint32_t> first, neighbour;
  Numbers stiffness, alarm, records;
  AlignedArray<double> shares;
};

struct Block {
  const BlockLayout* layout = nullptr;
  std::size_t number = 0;  ///< its place among the blocks
  std::vector<Row> rows;   ///< the layout's, with their supports
  Numbers displacement[4], velocity[4];
  AlignedArray<std::uint16_t> alive;
  AlignedArray<std::uint8_t> material;
  AlignedArray<std::uint32_t> mixture;
  AlignedArray<double> memory;  ///< of laws, see KernelRequest
  AlignedArray<double> scratch;
  ListedArrays listed;
  std::vector<double> damped_work;  ///< a row
  std::vector<RowSums> sums;        ///< a row
  std::vector<BoundaryParticle>
      boundary_particles;        ///< in the rows' order; their forces leave out prescribed axes
  std::vector<Vec3> held_force;  ///< of each support, N: the external force along prescribed axes
  std::vector<Contribution> contributions;

  /// A particle that a load watches.
  struct Watched {
    std::uint32_t load = 0,
                  number = 0;  ///< the load's, and the particle's among those that it watches
    std::uint64_t index = 0;
  };
  std::vector<Watched> watched;

  struct Broken {
    SpringEnds spring;
    double elongation;
    std::uint32_t row, neighbour;  ///< where the kernel found it, see AlarmRow
    std::int32_t site;
  };
  std::vector<Broken> broken;          ///< in this step, by row, neighbour, site
  std::vector<std::uint8_t> answers;   ///< of the failure criterion, for one batch
  std::uint32_t bad_answer = no_load;  ///< a load whose answer was not finite in the present sweep
};

}  // namespace hyperlattice
