// Sites, steps between them, and neighbours, as lattices, materials and kernels share them.
#pragma once

#include <hyperlattice/plain.hpp>

#include <array>

namespace hyperlattice {

inline constexpr std::size_t max_spring_classes = 4;
/// Forward neighbours; each has one bit in a site's alive bits.
inline constexpr std::size_t max_neighbours = 15;

/// A forward neighbour: a site that comes later in the order z, y, x, so that each pair is listed
/// once.
struct Neighbour {
  std::int32_t dx = 0, dy = 0, dz = 0;  ///< steps, in sites
  /// Spring class; the cubic lattice has 0 orthogonal, 1 diagonal.
  std::uint32_t spring_class = 0;
};

/// The rule for where a body ends. particles: at its last particles, which are whole, with whole
/// springs. cells: the body is a union of cells, each from site (i, j, k) to (i + 1, j + 1, k + 1),
/// with particles at their corners; a particle or spring at the surface counts by the fraction of
/// its cells that exist. partial_cells: as cells, but each cell counts by the share of its volume
/// that lies inside the shape.
enum class Boundary : std::uint32_t { particles, cells, partial_cells };

/// Returns whether particles stand at the corners of cells.
constexpr bool has_cells(Boundary boundary) { return boundary != Boundary::particles; }

/// Three steps between sites, in units of the spacing; rows of sites run along the first.
using Basis = std::array<Vec3, 3>;
inline constexpr Basis cubic_basis{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

constexpr Vec3 combined(const Basis& basis, double i, double j, double k) {
  return i * basis[0] + j * basis[1] + k * basis[2];
}

}  // namespace hyperlattice
