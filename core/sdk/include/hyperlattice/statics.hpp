// The body as a static or an implicit solver sees it: a box of sites with one number for each
// component, the forces of the springs for given displacements, and the forces of the loads. Plain
// data and functions; the numerical method belongs to the solver. A listed lattice has no box: each
// particle is a place, and the springs are listed too.
//
// A field has one number for each component and place, [c * places + place]: m or N along x, y, z
// and, with a free membrane, of the height. Site (i, j, k) of the box is at
//   place = origin + i + j * row + k * plane.
// The place of a neighbour is a constant step away, also at the border of the box, because a margin
// that no particle owns surrounds it. Places without a particle hold zeros. A row with its margin
// is at least one vector long, and so is the part after the last row of a plane.
#pragma once

#include <hyperlattice/kernel_request.hpp>

namespace hyperlattice {

/// A row of particles at sites begin <= i < end; gaps are possible.
struct StaticRow {
  std::int32_t begin = 0, end = 0;
};

/// A spring of a listed lattice.
struct StaticSpring {
  std::int64_t a = 0, b = 0;  ///< places of its ends
  Vec3 rest;                  ///< rest vector from a to b, m
};

/// The places of the corners of a tetrahedron of a listed lattice. A place has a quarter of the
/// volume of each of its tetrahedra.
using StaticTetrahedron = std::array<std::uint32_t, 4>;

/// Layout of the fields: the box of sites, or the places of a listed lattice.
struct StaticGrid {
  std::array<std::int32_t, 3> sites{};  ///< box of sites
  std::int64_t row = 0, plane = 0, origin = 0, places = 0;
  int components = 3;            ///< 4 with a free membrane
  double spacing = 0;            ///< l, metres
  double membrane_distance = 0;  ///< Delta, metres
  std::span<const NeighbourGeometry> neighbours;
  std::span<const StaticRow> rows;        ///< [k * ny + j]
  bool cells = false;                     ///< cells have volumetric energies
  bool inertia = false;                   ///< forces include inertia, see StaticProblem::begin_step
  bool tears = false;                     ///< springs may break, so that pieces may be loose
  bool listed = false;                    ///< sites, neighbours and rows are empty
  std::span<const StaticSpring> springs;  ///< springs of a listed lattice
  /// Tetrahedra of a listed lattice whose places have volumetric energies; else empty.
  std::span<const StaticTetrahedron> tetrahedra;
  /// Bits of each place, bit c: the place has a particle that may move along c.
  const std::uint8_t* free = nullptr;
  int threads = 1;

  /// Returns the place of site (i, j, k).
  std::int64_t place(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return origin + i + j * row + k * plane;
  }
  /// Returns the constant step from a place to its neighbour.
  std::int64_t step_to(const Neighbour& n) const { return n.dx + n.dy * row + n.dz * plane; }
  /// Returns whether numbers have a stiffness of their own.
  bool has_own() const { return components == 4 || inertia || tears; }
  /// Returns the size of a field.
  std::size_t numbers() const {
    return static_cast<std::size_t>(components) * static_cast<std::size_t>(places);
  }
};

/// Tangents of all springs (kernels/tangent.hpp), N/m, by neighbour and place, [n * places +
/// place], or one for each listed spring; 0 where there is no spring. They include fractions of
/// springs and omit broken springs. With three components `axial` and `pull` include the cross
/// springs, and the last three arrays are not used.
struct SpringTangents {
  float *axial = nullptr, *pull = nullptr, *cross_axial = nullptr, *cross_pull = nullptr;
  /// Stiffness of each number against its own change, [component * places + place]: of alpha
  /// springs, with StaticGrid::inertia of inertia, and what StaticProblem::hold() adds. Only with
  /// StaticGrid::has_own().
  float* own = nullptr;
  /// Volumetric energy of the cell of which each place is the lowest corner, times its share: p' l
  /// / 16 and p l / 16, with the pressure p and its derivative (volumetric_cell.hpp), N/m; 0 where
  /// there is no cell. Only with StaticGrid::cells.
  float *cell_stiffness = nullptr, *cell_pressure = nullptr;
  /// Volumetric energy of each place of a list: l^4 dp/dV and p l, with its pressure p and volume
  /// V, N/m; 0 where it has ended. Only with StaticGrid::tetrahedra.
  float *volume_stiffness = nullptr, *volume_pressure = nullptr;
};

/// A search for the damage of cohesive materials that is at rest, for displacements that are.
struct DamageSearch {
  double share = 1;                        ///< fraction of the load that the displacements carry
  double least_share = 0, most_share = 1;  ///< between which the search may choose
  double most_growth = 1;  ///< largest growth of a particle's damage since the last accepted state
};

/// Its result.
struct DamageFound {
  /// The largest fraction of the load between the bounds at which damage has grown by no more than
  /// `most_growth`, or the least if it grows by more there. The stress is taken to be in proportion
  /// to the load; this holds where `share` is the fraction that was asked about.
  double share = 1;
  double change = 0;  ///< largest change of a particle's damage since the last search
};

/// A step in time: mean values lie at the part `forward` of the step, 0.5 to 1.
struct TimeStep {
  double length = 0, forward = 0.5;  ///< s; -
};

/// A body in the form that a static or an implicit solver needs.
struct StaticProblem {
  void* self = nullptr;
  StaticGrid grid;
  const double* state = nullptr;  ///< present displacements
  double (*respond_to)(void* self, const double* displacement, double* force,
                       const SpringTangents* tangents) noexcept = nullptr;
  void (*load_at)(void* self, double share, double* force) noexcept = nullptr;
  void (*prescribe_at)(void* self, double share, double* displacement) noexcept = nullptr;
  double (*scale_of)(void* self, const double* internal, const double* external) noexcept = nullptr;
  Vec3 (*position_of)(void* self, std::int64_t place) noexcept = nullptr;
  bool damages = false;  ///< whether materials are cohesive
  DamageFound (*grow_damage_at)(void* self, const double* displacement,
                                const DamageSearch& search) noexcept = nullptr;
  void (*restore_damage_at)(void* self) noexcept = nullptr;
  void (*begin_step_of)(void* self, const TimeStep& step) noexcept = nullptr;
  std::uint64_t broke = 0;  ///< springs that broke when the present state was accepted
  double growth = 0;        ///< largest growth of damage after a step in time
  void (*hold_with)(void* self, double stiffness) noexcept = nullptr;
  double (*overshoot_at)(void* self, double share, const double* displacement) noexcept = nullptr;
  std::span<const std::int64_t> (*places_in)(void* self, RegionId region) noexcept = nullptr;

  /// Computes the forces of the springs on every particle, N, held particles included, and the
  /// tangents if `tangents` is not null. Returns the stored energy, J.
  double respond(const double* displacement, double* force, const SpringTangents* tangents) const {
    return respond_to(self, displacement, force, tangents);
  }
  /// Computes the external forces, N, at the fraction `share`, 0 to 1, of the stage's change of
  /// load. At 0 they are in equilibrium with the state at the start of the stage.
  void load(double share, double* force) const { load_at(self, share, force); }
  /// Sets the held components of the field to the values that the loads prescribe at that fraction.
  void prescribe(double share, double* displacement) const {
    prescribe_at(self, share, displacement);
  }
  /// Returns the reference of out-of-balance forces, N: the mean force on held or on loaded
  /// particles, whichever is larger.
  double force_scale(const double* internal, const double* external) const {
    return scale_of(self, internal, external);
  }
  /// Finds the damage at rest under the stress of the displacements, never below that of the last
  /// accepted state. respond() has this damage from then on, and accept() keeps it. Only with
  /// `damages`.
  DamageFound grow_damage(const double* displacement, const DamageSearch& search) const {
    return grow_damage_at(self, displacement, search);
  }
  /// Returns to the damage of the last accepted state.
  void restore_damage() const { restore_damage_at(self); }
  /// Returns how far displacements, or the end of a step in time with this mean, are beyond the
  /// first failure of a spring: the largest fraction by which all elongations could be smaller and
  /// some failure criterion would still break a spring; negative if none would. Springs that break
  /// are removed when the state is accepted: see `broke`.
  double overshoot(double share, const double* displacement) const {
    return overshoot_at(self, share, displacement);
  }
  /// Adds a stiffness, N/m, of each number against its own change to the tangents that follow, not
  /// to the forces: equations of loose pieces then have a solution. 0 ends it. Only with
  /// StaticGrid::tears.
  void hold(double stiffness) const { hold_with(self, stiffness); }
  /// Begins a step of length h in time from the present state, u and v. Its unknown is the mean
  /// displacement w = u + forward (u' - u), where u' and v' are the state at the step's end:
  ///   m (v' - v) / h = f + F,   (u' - u) / h = v + forward (v' - v).
  /// F are the mean loads. The force f of a spring has the direction of its ends at w and the size
  /// of its mean elongation, e + forward (e' - e), over its mean length. So a spring in proportion
  /// to its elongation neither gains nor loses energy with forward = 0.5, however far it turns.
  ///
  /// Until the next step respond(w) gives f and inertia, -m (w - u - forward h v) / (forward h)^2,
  /// with the tangent of inertia in SpringTangents::own, and no energy; load() gives F and
  /// prescribe() sets the held components of w, at any share. Only of SolverHost::motion().
  void begin_step(const TimeStep& step) const { begin_step_of(self, step); }
  /// Returns the places of the particles of a region; empty if it has none.
  std::span<const std::int64_t> places(RegionId region) const { return places_in(self, region); }
  /// Returns the position at rest, m.
  Vec3 position(std::int64_t place) const { return position_of(self, place); }
};

/// The distance of a body from a state of rest.
struct RestReport {
  double residual = 0;  ///< largest component of an out-of-balance force over the mean force on
                        ///< held or loaded particles
  /// Estimated relative error of the displacements; negative: not known.
  double displacement_error = -1;
  std::uint64_t iterations = 0;  ///< iterations of the solver in this stage
};

}  // namespace hyperlattice
