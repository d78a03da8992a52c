#include <state/lost_cells.hpp>
#include <state/soft_cell.hpp>

#include <hyperlattice/volumetric_cell.hpp>

namespace hyperlattice {

namespace {

/// Returns the energy of a cell, J, half-way between its states before and after the last step.
double energy_of(const BlockSet& blocks, Site cell, double step) {
  const Model& model = blocks.model();
  const std::array<Particle, 8> corners = model.volumetric.corners(cell);
  CellCorners displacement, moved;
  for (std::size_t corner = 0; corner < corners.size(); ++corner) {
    const auto [block, index] = blocks.at(corners[corner]);
    for (int c = 0; c < 3; ++c) {
      moved[corner][c] = step * block->velocity[c][index];
      displacement[corner][c] = block->displacement[c][index] - moved[corner][c];
    }
  }
  const CellResponse response =
      cell_response(displacement, model.body.grid.spacing, model.volumetric.modulus(cell));
  double energy = response.energy;
  for (std::size_t corner = 0; corner < corners.size(); ++corner)
    energy -= 0.5 * dot(response.force[corner], moved[corner]);
  return energy;
}

}  // namespace

void lose_cells(const BlockSet& blocks, Particle a, std::uint32_t neighbour, double step,
                std::vector<double>& lost) {
  const Model& model = blocks.model();
  if (model.volumetric.empty()) return;
  const Neighbour& to = model.body.neighbours[neighbour];
  for (const std::int32_t steps : {to.dx, to.dy, to.dz})
    if (std::abs(steps) > 1) return;  // such a spring belongs to no cell
  const Site site = model.body.site(a);
  for_cells_of(to, [&](int di, int dj, int dk) {
    const Site cell{site.i + di, site.j + dj, site.k + dk};
    const Particle lowest = model.body.at(cell);
    if (lowest == Body::no_particle) return;
    const auto [block, index] = blocks.at(lowest);
    std::uint16_t& bits = block->alive[index];
    const bool acts = (bits & cell_bit) != 0;
    // The field of damage sees that its cell has lost the bit, and counts the energy.
    bits = static_cast<std::uint16_t>(bits & ~(cell_bit | soft_cell_bit));
    const bool is_known = blocks.is_whole() || blocks.is_mine(*block);
    lost.push_back(acts && is_known ? energy_of(blocks, cell, step) : 0);
  });
}

}  // namespace hyperlattice
