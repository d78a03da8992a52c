// The Delaunay triangulation of points in space: tetrahedra whose circumscribed spheres hold no
// other point.
#pragma once

#include <hyperlattice/plain.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace hyperlattice {

inline constexpr std::uint32_t no_tetrahedron = ~std::uint32_t{0};

struct Tetrahedron {
  /// Indices of points, with (b - a) . ((c - a) x (d - a)) >= 0 up to rounding.
  std::array<std::uint32_t, 4> corners{};
  /// Number n: the tetrahedron at the face opposite to corner n, or no_tetrahedron.
  std::array<std::uint32_t, 4> neighbours{};
};

/// Returns the Delaunay triangulation of at most 2^27 points. The result depends on the points
/// only, in their order. Points are rounded to 2^-32 of the longest edge of their box. Points on
/// one sphere or plane, or at one place, are moved by up to about 1e-6 of that edge where this is
/// needed, so tetrahedra may be flat. Tetrahedra at the convex hull with circumscribed spheres
/// several times larger than the box may be missing.
std::vector<Tetrahedron> delaunay(std::span<const Vec3> points);

}  // namespace hyperlattice
