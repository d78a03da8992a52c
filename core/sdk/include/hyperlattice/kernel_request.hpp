// The request to a kernel: one block of a body, and what to do with it. Plain data only.
#pragma once

#include <hyperlattice/law.hpp>
#include <hyperlattice/sites.hpp>

#include <cstddef>

namespace hyperlattice {

inline constexpr std::uint16_t particle_bit = 1u << 15;
/// The cell from this site to the next ones has a volumetric energy and all its springs.
inline constexpr std::uint16_t cell_bit = 1u << 14;
template <class Real>
/// Numbers in a pack of 64 bytes.
inline constexpr int lanes_of = 64 / static_cast<int>(sizeof(Real));
/// Lanes of sets of weights and of slots, for both precisions.
inline constexpr int lanes = lanes_of<double>;

/// One class of springs between two materials. Cross springs (beta, gamma) go from a particle to
/// the mirror copy of its neighbour.
struct SpringConstants {
  double stiffness = 0;        ///< k of the base spring, N/m
  double cross_stiffness = 0;  ///< k_beta or k_gamma, N/m
  double alarm = infinity;     ///< elongation above which the failure criterion is asked, m
  /// Constants of the law for the base spring and for the cross spring.
  double law[2][max_law_constants] = {};
};

/// Returns (L0 + elongation)^2 - L0^2, m2, lowered by the round-off error, so that an alarm comes
/// rather too early than too late.
template <class Real = double>
constexpr double squared_growth(double rest_length, double elongation) {
  constexpr double rounding = sizeof(Real) == sizeof(double) ? 1e-12 : 1e-4;
  const double growth = elongation * (2 * rest_length + elongation);
  return growth * (growth > 0 ? 1 - rounding : 1 + rounding);
}

/// Geometry of all springs to one neighbour.
struct NeighbourGeometry {
  Neighbour site;
  Vec3 rest;                     ///< rest vector, metres
  double rest_length = 0;        ///< |rest|
  double cross_rest_length = 0;  ///< sqrt(|rest|^2 + Delta^2)
};

inline constexpr std::uint64_t no_weights = ~std::uint64_t{0};
/// Place of the set of weights for vectors whose particles and springs all count in full.
inline constexpr std::uint32_t whole_set = 0;

/// One row of particles: sites begin <= i < end of a line along x. The block's arrays hold the row
/// from `start` on, padded to whole vectors, so that no vector covers two rows.
struct Row {
  std::int32_t begin = 0, end = 0;
  std::uint64_t start = 0;       ///< place of site `begin` in the block's arrays
  std::uint32_t neighbours = 0;  ///< bit n: some site of the row has a spring to neighbour n
  std::int32_t material = 0;     ///< material of all springs of the row, or -1 if there are several
  /// Law of all springs of the row, by its number in the body; 0: the kernel's own; -1: several.
  /// Rows with another number than 0 are computed by KernelRequest::other_row.
  std::int32_t law = 0;
  /// Place of the first vector in KernelRequest::weight_sets; no_weights: all weights are 1.
  std::uint64_t weights = no_weights;
  /// The row's range in KernelRequest::boundary_particles.
  std::uint32_t first_boundary_particle = 0, last_boundary_particle = 0;
};

/// A particle with an external force or a prescribed motion. Few particles have one; the kernel
/// visits them after it has summed the forces on their row.
struct BoundaryParticle {
  std::uint64_t index = 0;  ///< place in the block's arrays
  std::int32_t row = 0;     ///< index in KernelRequest::rows
  std::int32_t site = 0;    ///< i of the particle's site
  double mass = 0;          ///< kg
  std::uint32_t axes = 0;   ///< bit c: the motion of component c is prescribed
  Vec3 force;               ///< external force at the start of the step, N
  Vec3 velocity;            ///< prescribed velocity of the step, m/s
  /// Result: back v(n-1/2) + forward v(n+1/2), m, the path over which the work of the force is
  /// counted.
  Vec3 path;
  double reaction_work = 0;  ///< result, summed over the run: work of the prescribed motion, J
  /// Result of measure(): the part of that work in the half step before now, J.
  double reaction_now = 0;
  /// Scratch of the kernel while it moves the row.
  double sum[3] = {}, speed_before[3] = {}, place_before[3] = {};
};

/// Springs of one row above their alarm, reported during a step.
struct AlarmRow {
  std::uint32_t row = 0;  ///< index in KernelRequest::rows
  /// Index of the neighbour; of a listed lattice: number of the slot.
  std::uint32_t neighbour = 0;
  /// Index i of each spring's site; of a listed lattice: place in the row.
  std::span<const std::int32_t> sites;
  std::span<const double> elongation;  ///< metres
};

/// A row in a block.
struct RowPlace {
  std::uint32_t index = 0;    ///< in KernelRequest::rows
  std::int32_t j = 0, k = 0;  ///< line and plane in the block; k < 0: a ghost plane
};

/// Energies of the springs of one row, J.
struct RowEnergies {
  double stored = 0;
  double dissipated = 0, fractured = 0;  ///< in the last step: by laws, and by laws that soften
};

/// Sums of a measurement over one row.
struct RowSums {
  double stored = 0;        ///< energy of the springs at u(n), J
  double kinetic = 0;       ///< 1/2 v(n-1/2).M.v(n+1/2), J: kinetic energy of the energy balance
  double kinetic_mean = 0;  ///< 1/2 M ((v(n-1/2) + v(n+1/2))/2)^2, J
  Vec3 momentum;            ///< momentum of the mean velocity, N s
  double potential = 0;     ///< work of the body acceleration since the start: sum m a.u, J
  double damped = 0;        ///< energy that damping and laws took in the half step before now, J
  double fractured = 0;     ///< energy that softening took since the last step, J
};

/// The springs of a block of a listed lattice. Particles are grouped into packs, with as many
/// particles as the state's precision has lanes. A pack has slots; each slot holds one spring of
/// each particle of the pack. A spring is stored twice, once at each end, so that every particle
/// sums its own forces.
struct ListedSlots {
  const std::uint32_t* first = nullptr;  ///< slots of pack n: first[n] .. first[n + 1]
  /// [slot][lane] record of the other end; the lane's own record: no spring. Has slots_ahead slots
  /// more than exist.
  std::uint32_t* neighbour = nullptr;
  // the next three are in the state's precision
  /// [slot][2][lane] stiffness of base and cross spring, N/m; null: KernelRequest::springs holds
  /// for all springs.
  const void* stiffness = nullptr;
  /// [slot][lane] alarm as growth of the squared length, m2; null: nothing breaks.
  const void* alarm = nullptr;
  /// [place][record_numbers], m: the block's own particles, then its ghosts.
  void* records = nullptr;
  /// Memory of laws that have one: [slot][base, cross][number][lane]; each end of a spring has a
  /// copy with equal bits.
  double* memory = nullptr;
};

/// Distance, in slots, at which a kernel prefetches the records of other ends.
inline constexpr std::size_t slots_ahead = 32;

/// The record of a particle of a list: x y z at rest, from any common origin; x y z of the
/// displacement at the start of the step, and the height (from record_moved on); the number of its
/// material. A kernel writes the displacements and heights of the block's own particles.
inline constexpr std::size_t record_numbers = 8, record_moved = 3, record_material = 7;

/// The volumetric energies of cells (volumetric_cell.hpp). The bit cell_bit of a site says whether
/// the cell of which it is the lowest corner has one.
struct VolumetricCells {
  double spacing = 0;  ///< l, m; 0: no cell has a volumetric energy
  double modulus = 0;  ///< K_v of every cell, Pa, if there are no moduli
  /// K_v times the cell's share, Pa, by site; null if all are alike.
  const double* moduli = nullptr;
};

/// A block of a body, and the step or measurement that a kernel makes of it.
struct KernelRequest {
  // the block: its own planes, with `reach` ghost planes before and after them
  std::int32_t rows_per_plane = 0;
  std::int32_t planes = 0;
  std::int32_t reach = 1;
  const Row* rows = nullptr;  ///< (reach + planes + reach) * rows_per_plane rows
  /// Displacements x y z and heights, m, in the kernel's precision; the last is null without a free
  /// membrane.
  void* displacement[4] = {};
  void* velocity[4] = {};  ///< velocities of the same components, m/s, in the kernel's precision
  /// Bits of each site, bit n: the spring to neighbour n exists; cell_bit; particle_bit: the site
  /// holds a particle.
  std::uint16_t* alive = nullptr;
  /// Material of each site, if springs depend on the materials of their ends; null: one material,
  /// or mixtures.
  const std::uint8_t* material = nullptr;
  /// If cells have materials: mixture of each site. Numbers below `materials` mean that material
  /// alone.
  const std::uint32_t* mixture = nullptr;
  /// [mixture * neighbours + n] place in `springs` of the springs to neighbour n from a site with
  /// this mixture.
  const std::uint32_t* mixture_springs = nullptr;
  /// Memory of laws that have one: [neighbour][base, cross][number][site]; no cross springs without
  /// a membrane.
  double* memory = nullptr;
  std::uint32_t memory_numbers = 0;  ///< numbers of each spring; a law may use fewer
  std::uint64_t memory_stride = 0;   ///< number of sites in `memory`
  /// For each vector of sites of a row with weights: the place of its set in `weights`. A set has
  /// `lanes` fractions of a whole particle (for mass and alpha), then for each neighbour `lanes`
  /// fractions of a whole spring (for force and energy, of cross springs too). Sites without a
  /// particle have the weight 1.
  const std::uint32_t* weight_sets = nullptr;
  const double* weights = nullptr;
  /// Springs of a listed lattice, which has one plane, no ghost planes, and rows whose begin is 0.
  ListedSlots listed;

  // the body
  std::span<const NeighbourGeometry> neighbours;
  const SpringConstants* springs = nullptr;  ///< [(material_i * materials + material_j) *
                                             ///< spring_classes + class], then those of mixtures
  const double* mass = nullptr;   ///< mass of a particle of each material, then of each mixture, kg
  const double* alpha = nullptr;  ///< k_alpha in the same order, N/m
  std::uint32_t materials = 1, spring_classes = 1;
  double membrane_distance = 0;  ///< Delta, metres
  bool exact = false;  ///< use roots and divisions instead of series, one neighbour at a time
  VolumetricCells cells;

  // the step: v(n+1/2) = v(n-1/2) + (back + forward) F(n) / m; u(n+1) = u(n) + 2 forward v(n+1/2)
  double back = 0;          ///< half of the last step, s; 0 at the start
  double forward = 0;       ///< half of this step, s
  double damping = 0;       ///< alpha of local damping
  double damping_rate = 0;  ///< rate c of the damping force c m v, 1/s
  Vec3 acceleration;        ///< acceleration of every particle, m/s2
  BoundaryParticle* boundary_particles = nullptr;
  void* self = nullptr;
  /// Asks the failure criterion about springs above their alarm. Null: springs have no alarm.
  /// Returns one flag for each spring: 1 removes it. Returns null if the criterion failed; the run
  /// ends.
  const std::uint8_t* (*review)(void* self, const AlarmRow& springs) noexcept = nullptr;
  /// Receives springs whose integrity became 0 in the step. They stay: a closed crack may push.
  void (*receive_gone)(void* self, const AlarmRow& springs) noexcept = nullptr;
  /// Computes the springs of a row whose law is not the kernel's: sets the row's own forces, which
  /// include those that earlier rows added, and adds to those of later rows.
  void (*other_row)(void* self, const RowPlace& row) noexcept = nullptr;

  // scratch and results
  /// Array of scratch_size(...) doubles, 64-byte aligned, zero at the start of the run; a kernel
  /// restores the zeros that others expect.
  void* scratch = nullptr;
  std::int32_t scratch_width = 0;  ///< numbers in a row of scratch
  /// For each row, ghosts included: energy that damping and laws took, summed over the run, J.
  double* damped_work = nullptr;
  double* fracture_work = nullptr;  ///< the same of laws that soften; null if there are none
  RowSums* sums = nullptr;  ///< for each row of the block, ghosts included; written by measure()
};

/// The springs of one row to one neighbour, for KernelSet::linearise. Arrays hold one number for
/// each spring, padded to whole vectors.
struct SpringRow {
  int count = 0;
  /// Displacements of both ends, m; the last is null without a free membrane.
  const double *here[4] = {}, *there[4] = {};
  /// In a step in time (StaticProblem::begin_step): displacements at its start, null at rest; the
  /// part of the step at which mean values lie, and the time from the start to it, s.
  const double *here_before[4] = {}, *there_before[4] = {};
  double forward = 1, time_step = 0;
  const double *stiffness = nullptr, *cross_stiffness = nullptr;  ///< N/m
  const double* weight = nullptr;  ///< fraction of a whole spring; 0: no spring
  /// Constants of the law for base and cross springs, if it has any.
  const double* law[2] = {};
  /// Memory of base and cross springs at the start of the load step, if the law has one: [number *
  /// memory_stride + spring].
  const double* memory[2] = {};
  std::uint64_t memory_stride = 0;
  Vec3 rest;
  double rest_length = 0, cross_rest_length = 0, membrane_distance = 0, spacing = 0;
  /// Results, N/m: see kernels/tangent.hpp.
  double *pull = nullptr, *axial = nullptr, *cross_pull = nullptr, *cross_axial = nullptr;
};

/// Largest distance, in sites along x, of a neighbour beyond the ends of a row; scratch rows are
/// longer by this at each end.
inline constexpr int scratch_margin = 16;

/// Returns how many numbers of scratch a kernel needs: received forces of (reach + 1) planes, and
/// the forces of the row itself.
constexpr std::size_t scratch_size(std::int32_t rows_per_plane, std::int32_t reach,
                                   std::int32_t width, std::size_t components) {
  return (static_cast<std::size_t>(reach + 1) * static_cast<std::size_t>(rows_per_plane) + 1) *
         components * static_cast<std::size_t>(width);
}

/// The places of rows in a block's scratch array. Real: precision of the forces.
template <class Real>
class ScratchRows {
 public:
  ScratchRows(const KernelRequest& request, int components)
      : scratch_(static_cast<double*>(request.scratch)),
        width_(request.scratch_width),
        rows_(request.rows_per_plane),
        reach_(request.reach),
        row_(components * request.scratch_width) {}

  /// Returns the forces on the row in work; element t belongs to site begin + t.
  Real* own(int c) const { return reinterpret_cast<Real*>(scratch_) + c * width_; }
  /// Returns the forces that a row received from earlier rows; element i belongs to site i. The
  /// address of a plane is the same for both precisions, so that steps and measurements find zeros
  /// there.
  Real* received(int c, int j, int k) const {
    return received_plane(k) + row_ * j + c * width_ + scratch_margin;
  }
  Real* received_plane(int k) const {
    return reinterpret_cast<Real*>(scratch_ + row_) + row_ * rows_ * ((k + reach_) % (reach_ + 1));
  }
  std::size_t plane_size() const { return static_cast<std::size_t>(row_ * rows_); }

 private:
  double* scratch_;
  std::ptrdiff_t width_, rows_, reach_, row_;
};

}  // namespace hyperlattice
