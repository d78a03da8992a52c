// The cells of a cubic lattice at the present time: their deformation, their own forces on their
// corners, and their stress. A cell is the cube between eight particles; a spring along one of its
// edges belongs to four cells, a spring across one of its faces to two. See docs/theory/stress.md.
#pragma once

#include <state/present_springs.hpp>
#include <state/tensor.hpp>

#include <hyperlattice/volumetric_cell.hpp>

#include <optional>

namespace hyperlattice {

struct PresentCell {
  Site site;  ///< of the corner with the lowest coordinates
  /// Corner n is one site further along x, y or z where bit 0, 1 or 2 of n is set.
  std::array<Particle, 8> corners{};
  double share = 1;           ///< part of the cell that counts, phi
  std::uint8_t material = 0;  ///< in a body of cells of several materials; else of the first corner
  bool is_whole = true;       ///< whether all its springs are there
  bool has_volumetric_energy = false;
  double remaining_tension = 1;  ///< what damage leaves of its volumetric energy if it is stretched
  /// Mean displacement gradient H of the trilinear field between the corners; F = I + H.
  Tensor gradient;
  std::array<Vec3, 8> moved{};  ///< displacements of the corners less that of the first one, m
  /// The cell's own force on each corner, N: its part of its springs, and of its volumetric energy.
  /// The forces of all cells around a particle of a body of cells add up to its internal force.
  /// Only if asked for.
  std::array<Vec3, 8> force{};
  double energy = 0;  ///< J: its part of its springs and alpha springs; only if asked for
};

/// Returns H = 1/(4 l) sum v_a (x) s_a of a field with x y z of each particle, per metre.
Tensor gradient_in(const PresentCell& cell, std::span<const double> xyz, double spacing);

/// Returns whether the body has cells: a cubic lattice whose springs do not leave a cell.
bool has_cells(const Body& body);

/// Adds the volumetric energy of a cell that has one, and its forces on the corners.
void add_volumetric_energy(const Model& model, PresentCell& cell);

/// Visits all cells whose corners are particles; in a body of cells those that fill the shape.
/// Calls for cells with a common corner follow each other in an order that no number of threads
/// changes; other calls, for cells of layers k that are not neighbours, may be at the same time. So
/// a visitor may add to numbers of the corners, or of the layer cell.site.k. It must not ask the
/// simulation for parallel work, such as a measurement.
void for_cells(const PresentSprings& springs, Asked asked,
               const std::function<void(const PresentCell&)>& visit);
/// Visits the cells of the layers low <= k < high only.
void for_cells(const PresentSprings& springs, Asked asked, std::int32_t low, std::int32_t high,
               const std::function<void(const PresentCell&)>& visit);

/// Returns the nominal stress P, Pa: force, by its first index, on an area at rest, by its second.
///   P = -1/(phi l^3) sum f_a (x) X_a = (1/l^3) sum (share of spring) f (x) R + U' cof F
Tensor nominal_stress(const PresentCell& cell, double spacing);
/// Returns the Cauchy stress, Pa: -1/(phi J l^3) sum f_a (x) x_a. It is symmetric but for
/// round-off. J is 1 for a cell that is not whole, because the opening of a crack is no volume of
/// the body. A cell that is inside out, J <= 0, has no stress.
std::optional<Tensor> cauchy_stress(const PresentCell& cell, double spacing);
/// Returns the energy per volume at rest, J/m3.
double energy_density(const PresentCell& cell, double spacing);

}  // namespace hyperlattice
