// The volumetric energies of the cells of a grid (<hyperlattice/volumetric_cell.hpp>): forces,
// energy and tangents. A cell belongs to the place of its lowest corner.
#include <state/soft_cell.hpp>
#include <statics/statics.hpp>

#include <hyperlattice/volumetric_cell.hpp>

namespace hyperlattice {

void Statics::make_cells(const std::vector<std::uint16_t>& alive) {
  problem_.grid.cells = !model_.volumetric.empty();
  if (!problem_.grid.cells) return;
  cell_modulus_.assign(static_cast<std::size_t>(problem_.grid.places), 0);
  model_.volumetric.for_cells([&](Site cell, double modulus) {
    const Particle lowest = model_.body.at(cell);
    if ((alive[lowest] & cell_bit) != 0)
      cell_modulus_[static_cast<std::size_t>(place_of(lowest))] = modulus;
  });
}

double Statics::respond_cells(std::int64_t first, std::size_t count, const double* u, double* force,
                              const SpringTangents* tangents) const {
  const StaticGrid& grid = problem_.grid;
  double energy = 0;
  for (std::size_t place = static_cast<std::size_t>(first), end = place + count; place < end;
       ++place) {
    const double modulus = cell_modulus_[place];
    CellResponse cell;
    if (modulus != 0) {
      CellCorners displacement;
      const auto of_corner = [&](std::size_t corner, std::size_t c) {
        const auto n = static_cast<std::int64_t>(corner);
        return c * static_cast<std::size_t>(grid.places) + place +
               static_cast<std::size_t>((n & 1) + (n >> 1 & 1) * grid.row + (n >> 2) * grid.plane);
      };
      for (std::size_t corner = 0; corner < 8; ++corner)
        for (std::size_t c = 0; c < 3; ++c) displacement[corner][c] = u[of_corner(corner, c)];
      cell = cell_shape(displacement, grid.spacing);
      if (moves()) {  // the mean of the growth at the step's start and at its end
        CellCorners start = displacement, end = displacement;
        for (std::size_t corner = 0; corner < 8; ++corner)
          for (std::size_t c = 0; c < 3; ++c) {
            start[corner][c] = state_[of_corner(corner, c)];
            end[corner][c] = end_of(of_corner(corner, c), u);
          }
        cell.volume_growth = step_->mean(cell_shape(start, grid.spacing).volume_growth,
                                         cell_shape(end, grid.spacing).volume_growth);
      }
      respond_to_growth(cell, grid.spacing, modulus);
      if (!cell_remains_.empty()) cell = soften(cell, cell_remains_[place]);
      energy += cell.energy;
      for (std::size_t corner = 0; corner < 8; ++corner)
        for (std::size_t c = 0; c < 3; ++c) force[of_corner(corner, c)] += cell.force[corner][c];
    }
    if (tangents == nullptr) continue;
    tangents->cell_stiffness[place] = static_cast<float>(cell.stiffness * grid.spacing / 16);
    tangents->cell_pressure[place] = static_cast<float>(cell.pressure * grid.spacing / 16);
  }
  return energy;
}

}  // namespace hyperlattice
