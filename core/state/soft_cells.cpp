// What damage leaves of the volumetric energy of cells (damage_cells.hpp).
#include <state/damage_field.hpp>

#include <algorithm>
#include <cmath>

namespace hyperlattice {

namespace {

/// Returns w, with the stored energy stiffness w^2 / 2.
double extension_of(const CellResponse& cell, double stiffness) {
  return std::copysign(std::sqrt(2 * cell.energy / stiffness), cell.volume_growth);
}

}  // namespace

CellResponse DamageField::response(const DamageCell& cell) const {
  CellCorners displacement;
  for (std::size_t n = 0; n < 8; ++n)
    for (int c = 0; c < 3; ++c) displacement[n][c] = cell.blocks[n]->displacement[c][cell.index[n]];
  return cell_response(displacement, model_.body.grid.spacing, cell.modulus);
}

/// Returns K_v l^3 times the cell's share, J.
double DamageField::stiffness_of(const DamageCell& cell) const {
  const double spacing = model_.body.grid.spacing;
  return cell.modulus * spacing * spacing * spacing;
}

/// Returns what remains of a cell that is stretched.
double DamageField::factor(const DamageCell& cell) const {
  double sum = 0;
  for (std::size_t n = 0; n < 4; ++n)
    sum += in_series(records_.remaining_of(cell.corners[n]),
                     records_.remaining_of(cell.corners[7 - n]));
  return sum / 4;
}

void DamageField::compute_cells(Part part) {
  DamageCells& cells = records_.cells();
  records_.for_indices(cells.numbers(),
                       [&](std::size_t n) { compute(cells[static_cast<std::uint32_t>(n)], part); });
}

/// Computes a cell. With its extension w, U = K_v w^2 / 2, it dissipates in a step, as springs do
/// (see compute() of records),
///   D = 1/2 (f_n - f_n+1) K_v l^3 w_n w_n+1.
/// A cell of which nothing remains is lost for good when it is stretched, so that fragments which
/// turn do not meet it again.
void DamageField::compute(DamageCell& cell, Part part) const {
  const bool whole = part == Part::all;
  if (cell.users == 0 || (whole && (rests(cell) || !is_mine(cell)))) return;
  if (whole) cell.force = {}, cell.stored = cell.dissipated = 0;
  cell.tension = 0;
  if (!cell.present) return;
  const bool lost_for_good = (cell.bits() & (cell_bit | soft_cell_bit)) == 0;
  if (lost_for_good && !whole) return;
  const CellResponse undamaged = response(cell);
  if (!lost_for_good) cell.tension = (1 + undamaged.volume_growth) * undamaged.pressure;
  if (!whole) return;
  const double stiffness = stiffness_of(cell), extension = extension_of(undamaged, stiffness);
  double f = lost_for_good ? 0 : 1;
  if (!lost_for_good && undamaged.volume_growth > 0) f = factor(cell);
  if (cell.handed_over) {
    if (!lost_for_good) {
      const CellResponse own = soften(undamaged, f);
      cell.force = own.force;
      cell.stored = own.energy;
    }
    const double stretched = lost_for_good ? 0 : factor(cell);
    cell.dissipated = stiffness * lost({cell.factor, cell.extension}, {f, extension},
                                       [&](double at) { return at > 0 ? stretched : 1; });
  }
  cell.extension = extension;
  cell.factor = f;
  if (f > 0) return;
  cell.present = false;
  cell.bits() = static_cast<std::uint16_t>(cell.bits() & ~soft_cell_bit);
}

/// Adds the parts of a particle in the cells around it to its record. Returns the mean of J U' of
/// these cells over the omega of the particle, Pa.
double DamageField::add_cells(std::uint32_t number, Part part) {
  DamageRecord& record = records_[number];
  const double own = records_.remaining(number);
  double tension = 0;
  for (std::size_t n = 0; n < 8; ++n) {
    if (record.cells.numbers[n] == DamageCells::none) continue;
    const DamageCell& cell = records_.cells()[record.cells.numbers[n]];
    const double other = records_.remaining_of(cell.corners[7 - n]);
    const bool degrades = cell.tension > 0 && own + other > 0;
    tension += (degrades ? 2 * other / (own + other) : 1) * cell.tension;
    if (part != Part::all || !cell.handed_over) continue;
    for (int c = 0; c < 3; ++c) record.force[static_cast<std::size_t>(c)] += cell.force[n][c];
    record.stored += cell.stored / 8;
    records_.note(number).dissipated += cell.dissipated / 8;
  }
  return tension / record.cells.share;
}

/// Keeps the extensions of the present state for the energy that the next one dissipates.
void DamageField::note_extensions() {
  DamageCells& cells = records_.cells();
  for (std::uint32_t number = 0; number < cells.numbers(); ++number) {
    DamageCell& cell = cells[number];
    if (cell.users == 0) continue;
    cell.extension = extension_of(response(cell), stiffness_of(cell));
  }
}

/// Returns whether a particle that this rank computes is a corner of the cell.
bool DamageField::is_mine(const DamageCell& cell) const {
  return blocks_.ranks().is_alone() ||
         std::any_of(cell.blocks.begin(), cell.blocks.end(),
                     [this](const Block* block) { return blocks_.is_mine(*block); });
}

bool DamageField::rests(const DamageCell& cell) const {
  return std::all_of(cell.corners.begin(), cell.corners.end(), [this](Particle corner) {
    const std::uint32_t record = records_.of(corner);
    return record == DamageRecords::none || rests(record);
  });
}

void DamageField::hand_over_cells(const DamageRecord& record) {
  for (const std::uint32_t number : record.cells.numbers) {
    if (number == DamageCells::none) continue;
    DamageCell& cell = records_.cells()[number];
    if (cell.handed_over || !cell.present) continue;
    if ((cell.bits() & cell_bit) == 0) {  // a criterion has broken one of its springs
      cell.present = false;
      continue;
    }
    cell.bits() = static_cast<std::uint16_t>((cell.bits() & ~cell_bit) | soft_cell_bit);
    cell.handed_over = true;
  }
}

std::optional<double> DamageField::cell_factor(Particle lowest) const {
  const std::uint32_t number = records_.cells().at(lowest);
  if (number == DamageCells::none) return std::nullopt;
  const DamageCell& cell = records_.cells()[number];
  if (!cell.handed_over || !cell.present) return std::nullopt;
  return factor(cell);
}

std::vector<SoftCell> DamageField::soft_cells() const {
  std::vector<SoftCell> found;
  const DamageCells& cells = records_.cells();
  for (std::uint32_t number = 0; number < cells.numbers(); ++number) {
    const DamageCell& cell = cells[number];
    if (cell.users == 0 || !cell.present) continue;
    const double f = factor(cell);
    if (cell.handed_over || f < 1) found.push_back({cell.corners[0], f});
  }
  std::sort(found.begin(), found.end(),
            [](const SoftCell& a, const SoftCell& b) { return a.lowest < b.lowest; });
  return found;
}

}  // namespace hyperlattice
