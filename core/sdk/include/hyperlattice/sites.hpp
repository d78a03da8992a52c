// Sites, steps between them, and neighbours: the words that lattices, materials and kernels share.
#pragma once

#include <hyperlattice/plain.hpp>

#include <array>

namespace hyperlattice {

inline constexpr std::size_t max_spring_classes = 4;
inline constexpr std::size_t max_neighbours =
    15;  ///< forward neighbours; one bit each in a site's alive bits

/// A forward neighbour: the site that follows in the order z, y, x, so that each pair stands once.
struct Neighbour {
  std::int32_t dx = 0, dy = 0, dz = 0;  ///< in sites
  std::uint32_t spring_class = 0;       ///< which stiffness: cubic has 0 orthogonal, 1 diagonal
};

/// How a body ends. particles: where its last particles are, each a whole one, with whole springs.
/// cells: it is a union of cells, each spanning the sites (i, j, k) to (i + 1, j + 1, k + 1), with
/// particles at their corners; particles and springs at its surface count by the share of their
/// cells that are there.
enum class Boundary : std::uint32_t { particles, cells };

/// Three steps from site to site, in units of the spacing; rows of sites run along the first.
using Basis = std::array<Vec3, 3>;
inline constexpr Basis cubic_basis{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

constexpr Vec3 combined(const Basis& basis, double i, double j, double k) {
  return i * basis[0] + j * basis[1] + k * basis[2];
}

}  // namespace hyperlattice
