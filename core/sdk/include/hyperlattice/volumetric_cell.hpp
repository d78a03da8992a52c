// The volumetric energy of a cubic cell: what makes Poisson ratios beyond the lattice's own,
// exactly isotropic. With the displacements u_a of the corners and their signs s_a = (+-1, +-1,
// +-1):
//   H = 1/(4 l) sum u_a (x) s_a                     mean displacement gradient of the cell
//   J = det(I + H),  y = J^(-1/3)
//   U = 9/2 K_v (J^(1/3) - 1)^2                     energy per volume at rest
//   p = U'(J) = 3 K_v y (1 - y)
//   f_a = -p l^2/4 cof(I + H) s_a                   force on corner a
// J - 1 is computed without cancellation. Below `least_volume` the pressure goes on linearly, so
// that a cell that is turned inside out is pushed back. See docs/theory/volumetric.md.
#pragma once

#include <hyperlattice/plain.hpp>

#include <array>
#include <cmath>

namespace hyperlattice {

/// A vector at each corner of a cell: number i + 2 j + 4 k of the corner i steps along x, j along y
/// and k along z from the lowest one.
using CellCorners = std::array<Vec3, 8>;

/// The least J at which the energy has its own form.
inline constexpr double least_volume = 1.0 / 64;

// Geometry, for numbers and for vectors of numbers. h[c][d]: derivative of displacement c along d.

/// Returns J - 1.
template <class Real>
[[gnu::always_inline]] inline Real volume_growth(const Real (&h)[3][3]) {
  const Real minor_x = h[1][1] * h[2][2] - h[1][2] * h[2][1],
             minor_y = h[1][2] * h[2][0] - h[1][0] * h[2][2],
             minor_z = h[1][0] * h[2][1] - h[1][1] * h[2][0];
  const Real trace = h[0][0] + h[1][1] + h[2][2];
  const Real minors =
      minor_x + (h[0][0] * h[1][1] - h[0][1] * h[1][0]) + (h[0][0] * h[2][2] - h[0][2] * h[2][0]);
  return trace + (minors + (h[0][0] * minor_x + h[0][1] * minor_y + h[0][2] * minor_z));
}

/// Sets the derivatives of J by the components of F = I + H: the cofactors of F.
template <class Real>
[[gnu::always_inline]] inline void set_cofactors(const Real (&h)[3][3], Real (&cofactors)[3][3]) {
  const Real x = Real(1) + h[0][0], y = Real(1) + h[1][1], z = Real(1) + h[2][2];
  cofactors[0][0] = y * z - h[1][2] * h[2][1];
  cofactors[0][1] = h[1][2] * h[2][0] - h[1][0] * z;
  cofactors[0][2] = h[1][0] * h[2][1] - y * h[2][0];
  cofactors[1][0] = h[0][2] * h[2][1] - h[0][1] * z;
  cofactors[1][1] = x * z - h[0][2] * h[2][0];
  cofactors[1][2] = h[0][1] * h[2][0] - x * h[2][1];
  cofactors[2][0] = h[0][1] * h[1][2] - h[0][2] * y;
  cofactors[2][1] = h[0][2] * h[1][0] - x * h[1][2];
  cofactors[2][2] = x * y - h[0][1] * h[1][0];
}

/// Pressure, its derivative and energy density of a cell over K_v.
struct VolumetricResponse {
  double pressure = 0;   ///< p = U'(J): positive if the cell is stretched
  double stiffness = 0;  ///< p'(J)
  double energy = 0;     ///< U
};

/// Returns the response to a change of volume J - 1 = `growth`.
[[gnu::always_inline]] inline VolumetricResponse volumetric_response(double growth) {
  if (!(growth < least_volume - 1)) {
    const double y = 1 / __builtin_cbrt(1 + growth), shrunk = growth * y * y * y / (1 + y + y * y),
                 stretch = shrunk / y;  // 1 - y, and J^(1/3) - 1
    return {3 * y * shrunk, y * y * y * y * (2 * y - 1), 4.5 * stretch * stretch};
  }
  constexpr double pressure = -36, stiffness = 1792, energy = 4.5 * 0.75 * 0.75;  // at least_volume
  const double below = growth - (least_volume - 1);
  return {pressure + stiffness * below, stiffness,
          energy + (pressure + 0.5 * stiffness * below) * below};
}

/// A cell at given displacements of its corners.
struct CellResponse {
  double gradient[3][3] = {};   ///< H: derivative of displacement [c] along axis [d]
  double cofactors[3][3] = {};  ///< of I + H
  double volume_growth = 0;     ///< J - 1
  double pressure = 0;          ///< p, Pa, positive if the cell is stretched
  double stiffness = 0;         ///< derivative of p by J, Pa
  double energy = 0;            ///< of the whole cell, J
  CellCorners force;            ///< on the corners, N
};

/// Returns the sign of a corner along an axis: 1 or -1.
constexpr double corner_sign(std::size_t corner, std::size_t axis) {
  return (corner >> axis & 1U) != 0 ? 1 : -1;
}

/// Returns the gradient of a cell, its cofactors and its growth; no response. `displacement`: of
/// its corners, m; `spacing`: l, m.
inline CellResponse cell_shape(const CellCorners& displacement, double spacing) {
  CellResponse cell;
  for (std::size_t d = 0; d < 3; ++d) {
    Vec3 sum;  // over the four edges along d
    for (std::size_t a = 0; a < 8; ++a)
      if (corner_sign(a, d) < 0) sum += displacement[a | std::size_t{1} << d] - displacement[a];
    for (std::size_t c = 0; c < 3; ++c) cell.gradient[c][d] = sum[c] / (4 * spacing);
  }
  set_cofactors(cell.gradient, cell.cofactors);
  cell.volume_growth = volume_growth(cell.gradient);
  return cell;
}

/// Adds pressure, stiffness and energy of a cell's growth. `modulus`: K_v times the cell's share,
/// Pa.
inline void respond_to_growth(CellResponse& cell, double spacing, double modulus) {
  const VolumetricResponse response = volumetric_response(cell.volume_growth);
  cell.pressure = modulus * response.pressure;
  cell.stiffness = modulus * response.stiffness;
  cell.energy = modulus * response.energy * spacing * spacing * spacing;
}

/// Adds the forces of a cell's pressure on its corners.
inline void push_corners(CellResponse& cell, double spacing) {
  const double factor = -cell.pressure * spacing * spacing / 4;
  for (std::size_t a = 0; a < 8; ++a)
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t d = 0; d < 3; ++d)
        cell.force[a][c] += factor * cell.cofactors[c][d] * corner_sign(a, d);
}

/// Returns the response of a cell. A cell without corners' springs has only this response.
inline CellResponse cell_response(const CellCorners& displacement, double spacing, double modulus) {
  CellResponse cell = cell_shape(displacement, spacing);
  respond_to_growth(cell, spacing, modulus);
  push_corners(cell, spacing);
  return cell;
}

}  // namespace hyperlattice
