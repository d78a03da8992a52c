// The body in search of a state of rest, as a static solver sees it: a box of sites with one number
// a component at each, what the springs answer to displacements, and what the loads ask. Plain data
// and functions; the numerics are the solver's. Of a listed lattice there is no box: each particle
// is a place, and the springs are listed too.
//
// A field has a number for each component and place, [c * places + place]: metres or newton along
// x, y, z and, where a membrane can move, of the height. Site (i, j, k) of the box is at place
// origin + i + j * row + k * plane; a neighbour's place is a fixed step away, also at the border of
// the box, where there is a margin that no particle owns. Places without a particle hold zeros. A
// row, with its margin, is at least a vector long, and so is what follows the last one of a plane.
#pragma once

#include <hyperlattice/kernel_request.hpp>

namespace hyperlattice {

/// Particles of a row stand at sites begin <= i < end; there may be gaps.
struct StaticRow {
  std::int32_t begin = 0, end = 0;
};

/// A spring of a listed lattice.
struct StaticSpring {
  std::int64_t a = 0, b = 0;  ///< places of its ends
  Vec3 rest;                  ///< from a to b, metres
};

struct StaticGrid {
  std::array<std::int32_t, 3> sites{};  ///< box of sites
  std::int64_t row = 0, plane = 0, origin = 0, places = 0;
  int components = 3;            ///< 4 where a membrane can move
  double spacing = 0;            ///< l, metres
  double membrane_distance = 0;  ///< Delta, metres
  std::span<const NeighbourGeometry> neighbours;
  std::span<const StaticRow> rows;        ///< [k * ny + j]
  bool listed = false;                    ///< sites, neighbours and rows are empty
  std::span<const StaticSpring> springs;  ///< of a listed lattice
  const std::uint8_t* free =
      nullptr;  ///< of each place, bit c: a particle is there and may move along c
  int threads = 1;

  std::int64_t place(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return origin + i + j * row + k * plane;
  }
  std::int64_t step_to(const Neighbour& n) const { return n.dx + n.dy * row + n.dz * plane; }
  std::size_t numbers() const {
    return static_cast<std::size_t>(components) * static_cast<std::size_t>(places);
  }
};

/// Tangents of all springs (kernels/tangent.hpp), N/m, by neighbour and place, [n * places +
/// place], or one a listed spring; 0 where there is no spring. Shares and broken springs are
/// counted. In three components cross springs are counted with their base springs, and the last
/// three are not used.
struct SpringTangents {
  float *axial = nullptr, *pull = nullptr, *cross_axial = nullptr, *cross_pull = nullptr;
  float* alpha = nullptr;  ///< of each place: stiffness of the height
};

struct StaticProblem {
  void* self = nullptr;
  StaticGrid grid;
  const double* state = nullptr;  ///< the present displacements
  double (*respond_to)(void* self, const double* displacement, double* force,
                       const SpringTangents* tangents) noexcept = nullptr;
  void (*load_at)(void* self, double share, double* force) noexcept = nullptr;
  void (*prescribe_at)(void* self, double share, double* displacement) noexcept = nullptr;
  double (*scale_of)(void* self, const double* internal, const double* external) noexcept = nullptr;
  Vec3 (*position_of)(void* self, std::int64_t place) noexcept = nullptr;

  /// Forces of the springs on every particle, N, held ones too; returns the energy stored, J.
  /// Tangents if asked.
  double respond(const double* displacement, double* force, const SpringTangents* tangents) const {
    return respond_to(self, displacement, force, tangents);
  }
  /// External forces, N, when a share from 0 to 1 of the stage's change of load has come. At 0 the
  /// state that the stage began with is at rest.
  void load(double share, double* force) const { load_at(self, share, force); }
  /// Sets the held components of the field to what the loads prescribe at that share.
  void prescribe(double share, double* displacement) const {
    prescribe_at(self, share, displacement);
  }
  /// What an out-of-balance force is compared with, N: the mean force on held or on loaded
  /// particles, whichever is larger.
  double force_scale(const double* internal, const double* external) const {
    return scale_of(self, internal, external);
  }
  Vec3 position(std::int64_t place) const { return position_of(self, place); }  ///< metres, at rest
};

/// How near to rest a body is.
struct RestReport {
  double residual = 0;  ///< largest component of an out-of-balance force over the mean force on
                        ///< held or loaded particles
  double displacement_error =
      -1;  ///< estimated error of the displacements, a share of them; below 0: not known
  std::uint64_t iterations = 0;  ///< of the solver, so far in this stage
};

}  // namespace hyperlattice
