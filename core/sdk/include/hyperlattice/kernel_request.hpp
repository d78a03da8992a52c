// What a kernel is given: one block of a body, and what to do with it. Plain data only.
#pragma once

#include <hyperlattice/law.hpp>
#include <hyperlattice/sites.hpp>

namespace hyperlattice {

inline constexpr std::uint16_t particle_bit = 1u << 15;
template <class Real>
inline constexpr int lanes_of = 64 / static_cast<int>(sizeof(Real));  ///< numbers in a vector
inline constexpr int lanes =
    lanes_of<double>;  ///< of sets of weights and of slots, whatever the precision

/// One class of springs between two materials. Cross springs (beta, gamma) go from a particle to
/// the mirror copy of its neighbour.
struct SpringConstants {
  double stiffness = 0;        ///< k of the base spring, N/m
  double cross_stiffness = 0;  ///< k_beta or k_gamma, N/m
  double alarm = infinity;     ///< elongation above which a failure criterion must be asked, metres
  double law[2][max_law_constants] = {};  ///< of the base spring, of the cross spring
};

/// (L0 + elongation)^2 - L0^2, lowered by rounding's worth so that an alarm rings rather too early
/// than too late.
template <class Real = double>
constexpr double squared_growth(double rest_length, double elongation) {
  constexpr double rounding = sizeof(Real) == sizeof(double) ? 1e-12 : 1e-4;
  const double growth = elongation * (2 * rest_length + elongation);
  return growth * (growth > 0 ? 1 - rounding : 1 + rounding);
}

/// The same for all springs to one neighbour.
struct NeighbourGeometry {
  Neighbour site;
  Vec3 rest;                     ///< rest vector, metres
  double rest_length = 0;        ///< |rest|
  double cross_rest_length = 0;  ///< sqrt(|rest|^2 + Delta^2)
};

inline constexpr std::uint64_t no_weights = ~std::uint64_t{0};
inline constexpr std::uint32_t whole_set =
    0;  ///< place of the set of weights of a vector whose particles and springs all count in full

/// One row of particles: sites begin <= i < end of a line along x, stored from `start` on, padded
/// to whole vectors, so that none straddles two rows.
struct Row {
  std::int32_t begin = 0, end = 0;
  std::uint64_t start = 0;       ///< place of site `begin` in the block's arrays
  std::uint32_t neighbours = 0;  ///< bit n: some site of the row has a spring to neighbour n
  std::int32_t material = 0;     ///< of all springs that touch the row, or -1 if they are several
  std::uint64_t weights = no_weights;  ///< place of its first vector's in
                                       ///< KernelRequest::weight_sets; none: all weights are 1
  std::uint32_t first_boundary_particle = 0,
                last_boundary_particle = 0;  ///< its range in KernelRequest::boundary_particles
};

/// A particle with an external force or a prescribed motion. Few particles have one; they are
/// visited after their row is summed.
struct BoundaryParticle {
  std::uint64_t index = 0;  ///< place in the block's arrays
  std::int32_t row = 0;     ///< in KernelRequest::rows
  std::int32_t site = 0;    ///< i
  double mass = 0;          ///< kg
  std::uint32_t axes = 0;   ///< bits: components whose motion is prescribed
  Vec3 force;               ///< external force at the step's start, newton
  Vec3 velocity;            ///< prescribed velocity of the step, m/s
  Vec3 path;  ///< result: back v(n-1/2) + forward v(n+1/2), what the force's work is counted over,
              ///< metres
  double reaction_work = 0;  ///< result, summed over the run: joule that the prescription put in
  double reaction_now =
      0;  ///< result of measure(): its part that belongs to half a step before now, joule
  double sum[3] = {}, speed_before[3] = {},
         place_before[3] = {};  ///< the kernel's own notes while it moves the row
};

/// A spring above its alarm, reported during a step.
struct AlarmRow {
  std::uint32_t row = 0;                ///< index in KernelRequest::rows
  std::uint32_t neighbour = 0;          ///< which spring; of a listed lattice: which slot
  std::span<const std::int32_t> sites;  ///< i of each; of a listed lattice: the place in the row
  std::span<const double> elongation;   ///< metres
};

/// Sums of a measurement over one row.
struct RowSums {
  double stored = 0;        ///< energy of the springs at u(n), J
  double kinetic = 0;       ///< 1/2 v(n-1/2).M.v(n+1/2), J: the scheme's own
  double kinetic_mean = 0;  ///< 1/2 M ((v(n-1/2) + v(n+1/2))/2)^2, J
  Vec3 momentum;            ///< of the mean velocity, N s
  double potential = 0;     ///< work of the body acceleration since the start: sum m a.u, J
  double damped = 0;        ///< energy that damping took in the half step before now, J
};

/// The springs of a block of a listed lattice. Particles stand in packs of as many as the state's
/// precision has lanes; a pack has slots, each with one spring of each of its particles. A spring
/// stands twice, once with each of its ends, so that every particle sums the forces on itself.
struct ListedSlots {
  const std::uint32_t* first = nullptr;  ///< of each pack: its slots are first[n] .. first[n + 1]
  std::uint32_t* neighbour = nullptr;    ///< [slot][lane] the other end's record; the lane's own:
                                         ///< there is no spring. slots_ahead more than there are
  // in the state's precision
  const void* stiffness = nullptr;  ///< [slot][2][lane] of base and cross spring, N/m; null: the
                                    ///< same for all, KernelRequest::springs
  const void* alarm =
      nullptr;  ///< [slot][lane] as the growth of the squared length, m2; null: nothing breaks
  void* records =
      nullptr;  ///< [place][record_numbers], metres: the block's own places, then its ghosts
  double* memory = nullptr;  ///< of laws that have one: [slot][base, cross][number][lane]; each end
                             ///< of a spring has its own, of the same bits
};

/// How many slots ahead of its springs a kernel asks the memory for their other ends.
inline constexpr std::size_t slots_ahead = 32;

/// Of a particle of a list: x y z at rest, from any one point; x y z of the displacement at the
/// step's start, and the height; its material's number. A kernel writes what moves of the block's
/// own particles.
inline constexpr std::size_t record_numbers = 8, record_moved = 3, record_material = 7;

struct KernelRequest {
  // the block: planes [first, first + planes) are its own; `reach` ghost planes stand before and
  // after them
  std::int32_t rows_per_plane = 0;
  std::int32_t planes = 0;
  std::int32_t reach = 1;
  const Row* rows = nullptr;   ///< (reach + planes + reach) * rows_per_plane rows
  void* displacement[4] = {};  ///< x y z and height over the mirror plane's rest, metres; last is
                               ///< null without a membrane. In the
  void* velocity[4] = {};      ///< kernel's precision, as are velocities, m/s
  std::uint16_t* alive =
      nullptr;  ///< bit n: the spring to neighbour n exists; bit 15: the site holds a particle
  const std::uint8_t* material = nullptr;  ///< of each site, if springs are between the materials
                                           ///< of their ends; null: one material, or mixtures
  /// If cells have materials: of each site, what the cells around it are of. Numbers below
  /// `materials` are of that material alone.
  const std::uint32_t* mixture = nullptr;
  const std::uint32_t* mixture_springs =
      nullptr;  ///< [mixture * neighbours + n] place in `springs` of the springs from such a site
  double* memory = nullptr;  ///< of laws that have one: [neighbour][base, cross][number][site];
                             ///< without a membrane no cross springs
  std::uint64_t memory_stride = 0;  ///< sites
  /// Of rows that have weights, for each vector of sites the place in `weights` of its set: `lanes`
  /// shares of a whole particle (mass, alpha), then for each neighbour `lanes` shares of a whole
  /// spring (force and energy, cross springs' too). Sites without a particle weigh 1.
  const std::uint32_t* weight_sets = nullptr;
  const double* weights = nullptr;
  ListedSlots listed;  ///< of a listed lattice: one plane, no ghost planes, a row for each stretch
                       ///< of particles, whose begin is 0

  // the body
  std::span<const NeighbourGeometry> neighbours;
  const SpringConstants* springs = nullptr;  ///< [(material_i * materials + material_j) *
                                             ///< spring_classes + class], then those of mixtures
  const double* mass = nullptr;   ///< of each material's particle, then of each mixture's, kg
  const double* alpha = nullptr;  ///< k_alpha of the same, N/m
  std::uint32_t materials = 1, spring_classes = 1;
  double membrane_distance = 0;  ///< Delta, metres
  bool exact = false;  ///< roots and divisions in place of series, one neighbour at a time

  // the step: v(n+1/2) = v(n-1/2) + (back + forward) F(n) / m; u(n+1) = u(n) + 2 forward v(n+1/2)
  double back = 0;          ///< half of the step before, s; 0 at the start
  double forward = 0;       ///< half of this step, s
  double damping = 0;       ///< alpha of local damping
  double damping_rate = 0;  ///< c of damping in proportion to mass and velocity, 1/s
  Vec3 acceleration;        ///< of every particle, m/s2
  BoundaryParticle* boundary_particles = nullptr;
  void* self = nullptr;
  /// Asks the criterion about springs above their alarm; returns a flag a spring: 1 remove it.
  /// Null: the criterion failed, the run ends.
  const std::uint8_t* (*review)(void* self, const AlarmRow& springs) noexcept = nullptr;

  // scratch and results
  void* scratch = nullptr;  ///< scratch_size(...) doubles, 64-byte aligned, zero at first; a kernel
                            ///< leaves what others find zero
  std::int32_t scratch_width = 0;  ///< numbers in a scratch row
  double* damped_work =
      nullptr;  ///< one number a row, ghosts too: energy that damping took, summed over the run, J
  RowSums* sums = nullptr;  ///< one a row of the block, ghosts too; for measure()
};

/// The springs of one row to one neighbour, for KernelSet::linearise. Arrays hold one number a
/// spring, padded to whole vectors.
struct SpringRow {
  int count = 0;
  const double *here[4] = {}, *there[4] = {};  ///< displacements of both ends, metres; last is null
                                               ///< without a membrane that moves
  const double *stiffness = nullptr, *cross_stiffness = nullptr;  ///< N/m
  const double* weight = nullptr;  ///< share of a whole spring; 0: there is none
  Vec3 rest;
  double rest_length = 0, cross_rest_length = 0, membrane_distance = 0, spacing = 0;
  double *pull = nullptr, *axial = nullptr, *cross_pull = nullptr,
         *cross_axial = nullptr;  ///< results, N/m; see kernels/tangent.hpp
};

/// Sites left and right of a row that its neighbours may reach; scratch rows are that much wider on
/// each side.
inline constexpr int scratch_margin = 16;

/// Numbers of scratch that a kernel needs: received forces of (reach + 1) planes, and the row's
/// own.
constexpr std::size_t scratch_size(std::int32_t rows_per_plane, std::int32_t reach,
                                   std::int32_t width, std::size_t components) {
  return (static_cast<std::size_t>(reach + 1) * static_cast<std::size_t>(rows_per_plane) + 1) *
         components * static_cast<std::size_t>(width);
}

}  // namespace hyperlattice
