// A cell whose volumetric energy the field of damage lowers (damage_field.hpp).
#pragma once

#include <hyperlattice/volumetric_cell.hpp>

#include <cstdint>
#include <vector>

namespace hyperlattice {

/// In the bits of a site (KernelRequest::alive): the field of damage computes the cell in place of
/// the kernels. No neighbour of the cubic lattice has this bit.
inline constexpr std::uint16_t soft_cell_bit = 1u << 13;

struct SoftCell {
  Particle lowest = 0;  ///< its lowest corner
  double factor = 1;    ///< of its tension; a cell that is pressed together keeps its stiffness
};

/// Returns the response of a cell of whose tension the part `factor` remains.
inline CellResponse soften(CellResponse cell, double factor) {
  if (!(cell.volume_growth > 0)) return cell;
  cell.pressure *= factor;
  cell.stiffness *= factor;
  cell.energy *= factor;
  for (Vec3& force : cell.force) force = factor * force;
  return cell;
}

}  // namespace hyperlattice
