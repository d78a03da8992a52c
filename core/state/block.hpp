// One block of the state: its arrays, its boundary particles and the breakages of the present step.
#pragma once

#include <state/layout.hpp>
#include <state/numbers.hpp>

#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <vector>

namespace hyperlattice {

inline constexpr std::uint32_t not_watched = ~std::uint32_t{0}, no_load = ~std::uint32_t{0};

/// The effect of one load on one boundary particle, or the answer of a load to a watched one.
struct Contribution {
  std::uint32_t support = 0, load = 0;
  Particle particle = 0;
  /// Number among the load's watched particles: the force is then the load's answer, not an
  /// amplitude.
  std::uint32_t watched = not_watched;
  Vec3 force, displacement, velocity;  ///< amplitudes
  Axes displaced = 0, driven = 0;
  Vec3 goal;                 ///< displacement along driven axes while time is held, m
  double factor = 0;         ///< load factor in the present step
  double work = 0;           ///< of the force since the start, J
  double reaction_work = 0;  ///< of the reaction to the prescribed motion since the start, J
};

/// Additional arrays of a block of a listed body; see ListedSlots.
struct ListedArrays {
  AlignedArray<std::uint32_t> first, neighbour;
  Numbers stiffness, alarm, records;
  /// [record][component] velocities half a step before, m/s; empty unless a criterion asks for the
  /// rate.
  Numbers velocity;
  AlignedArray<double> shares;
};

/// A spring as kernels name it (see AlarmRow), and a failure criterion that keeps numbers for it.
struct FailureKey {
  std::uint32_t row = 0, neighbour = 0;
  std::int32_t site = 0;
  std::uint32_t criterion = 0;  ///< see Material::Criterion::number
  auto operator<=>(const FailureKey&) const = default;
};
/// The memory of failure criteria. It holds only springs that were above the alarm of such a
/// criterion and are whole.
using FailureMemory = std::map<FailureKey, std::array<double, max_failure_memory>>;

struct Block {
  const BlockLayout* layout = nullptr;
  std::size_t number = 0;  ///< index among the blocks
  std::vector<Row> rows;   ///< the layout's rows with their boundary particles
  Numbers displacement[4], velocity[4];
  /// Distance of the components of displacement, and of velocity, which are in one piece of memory.
  std::size_t component_stride = 0;
  AlignedArray<std::uint16_t> alive;
  AlignedArray<std::uint8_t> material;
  AlignedArray<std::uint32_t> mixture;
  AlignedArray<double> cell_moduli;  ///< see VolumetricCells; empty if all are alike
  AlignedArray<double> memory;       ///< of laws, see KernelRequest
  FailureMemory failure_memory;
  AlignedArray<double> scratch;
  ListedArrays listed;
  std::vector<double> damped_work;    ///< per row, J
  std::vector<double> fracture_work;  ///< per row, of laws that soften, J; empty if there are none
  /// Energies of the rows whose springs the kernel did not compute, from the last measurement, per
  /// row; empty if there are no such rows.
  std::vector<RowEnergies> other_sums;
  std::vector<RowSums> sums;  ///< per row
  /// In the order of the rows. Their forces have no component along prescribed axes.
  std::vector<BoundaryParticle> boundary_particles;
  /// External force along prescribed axes on each boundary particle, N.
  std::vector<Vec3> held_force;
  std::vector<Contribution> contributions;

  /// A particle that a load watches.
  struct Watched {
    /// The load's number, and the particle's number among those that the load watches.
    std::uint32_t load = 0, number = 0;
    std::uint64_t index = 0;
  };
  std::vector<Watched> watched;

  struct Broken {
    SpringEnds spring;
    double elongation;
    std::uint32_t row, neighbour;  ///< place in the kernel's AlarmRow
    std::int32_t site;
    bool softened = false;  ///< its integrity became 0; it stays
    double energy = 0;      ///< lost with it, J
  };
  std::vector<Broken> broken;  ///< in this step, in the order of row, neighbour, site
  /// Particles beside springs above the alarm of their cohesive material, see DamageField.
  std::vector<Particle> noted;
  std::vector<std::uint8_t> answers;  ///< of the failure criterion to one batch
  /// A load whose answer was not finite in the present sweep.
  std::uint32_t bad_answer = no_load;
};

}  // namespace hyperlattice
