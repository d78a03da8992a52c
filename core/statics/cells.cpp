// The volumetric energies of the cells of a grid (<hyperlattice/volumetric_cell.hpp>): forces,
// energy and tangents. A cell belongs to the place of its lowest corner.
#include <state/soft_cell.hpp>
#include <statics/statics.hpp>

#include <hyperlattice/volumetric_cell.hpp>

namespace hyperlattice {

namespace {

double determinant(const double (&m)[3][3]) {
  double sum = 0;
  for (int c = 0; c < 3; ++c)
    sum +=
        m[0][c] * (m[1][(c + 1) % 3] * m[2][(c + 2) % 3] - m[1][(c + 2) % 3] * m[2][(c + 1) % 3]);
  return sum;
}

/// Adds the response of a cell in a step in time from one shape to another. The pressure is the
/// mean over the growth J, by Simpson's rule, p = (U_1 - U_0) / (J_1 - J_0) but for terms of the
/// fourth order. The cell's forces do the work p D, with D = cof F : (F_1 - F_0) at the mean shape,
/// and J_1 - J_0 = D + q, q = det(F_1 - F_0) / 4. The factor 1 + q D / (D^2 + q^2), nearly (D + q)
/// / D, makes this the change of the energy; it changes no direction, so that angular momentum
/// stays.
void respond_to_step(const CellResponse& start, const CellResponse& end, double forward,
                     double spacing, double modulus, CellResponse& mean) {
  const double from = start.volume_growth, to = end.volume_growth;
  mean.volume_growth = (1 - forward) * from + forward * to;
  respond_to_growth(mean, spacing, modulus);
  if (forward != 0.5) return;  // numerical damping: energy is not kept
  mean.pressure = (4 * mean.pressure + modulus * (volumetric_response(from).pressure +
                                                  volumetric_response(to).pressure)) /
                  6;
  double change[3][3], along = 0;
  for (int c = 0; c < 3; ++c)
    for (int d = 0; d < 3; ++d) {
      change[c][d] = end.gradient[c][d] - start.gradient[c][d];
      along += mean.cofactors[c][d] * change[c][d];
    }
  const double beyond = determinant(change) / 4, square = along * along + beyond * beyond;
  if (square > 0) mean.pressure *= 1 + beyond * along / square;
}

}  // namespace

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
      if (moves()) {
        CellCorners start = displacement, end = displacement;
        for (std::size_t corner = 0; corner < 8; ++corner)
          for (std::size_t c = 0; c < 3; ++c) {
            start[corner][c] = state_[of_corner(corner, c)];
            end[corner][c] = end_of(of_corner(corner, c), u);
          }
        respond_to_step(cell_shape(start, grid.spacing), cell_shape(end, grid.spacing),
                        step_->of.forward, grid.spacing, modulus, cell);
      } else {
        respond_to_growth(cell, grid.spacing, modulus);
      }
      push_corners(cell, grid.spacing);
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
