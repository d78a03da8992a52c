#include <state/damage_cells.hpp>

#include <tuple>

namespace hyperlattice {

std::uint32_t DamageCells::at(Particle lowest) const {
  const auto found = by_lowest_.find(lowest);
  return found == by_lowest_.end() ? none : found->second;
}

CellsOfParticle DamageCells::follow(Particle particle) {
  CellsOfParticle found;
  found.numbers.fill(none);
  if (empty()) return found;
  const Body& body = model_.body;
  const Site site = body.site(particle);
  for (std::int32_t corner = 0; corner < 8; ++corner) {
    const Site cell{site.i - (corner & 1), site.j - (corner >> 1 & 1), site.k - (corner >> 2)};
    if (!model_.volumetric.holds(cell)) continue;
    found.share += body.cells.empty() ? 1 : body.cells.share_of_cell(cell);
    if (model_.volumetric.modulus(cell) == 0) continue;
    const std::uint32_t number = number_of(cell, body.at(cell));
    ++cells_[number].users;
    found.numbers[static_cast<std::size_t>(corner)] = number;
  }
  return found;
}

std::uint32_t DamageCells::number_of(Site cell, Particle lowest) {
  if (const std::uint32_t known = at(lowest); known != none) return known;
  if (unused_.empty()) {
    unused_.push_back(static_cast<std::uint32_t>(cells_.size()));
    cells_.emplace_back();
  }
  const std::uint32_t number = unused_.back();
  unused_.pop_back();
  by_lowest_.emplace(lowest, number);
  DamageCell& own = cells_[number] = {};
  own.corners = model_.volumetric.corners(cell);
  own.modulus = model_.volumetric.modulus(cell);
  for (std::size_t n = 0; n < 8; ++n)
    std::tie(own.blocks[n], own.index[n]) = blocks_.at(own.corners[n]);
  own.present = (own.bits() & cell_bit) != 0;
  return number;
}

void DamageCells::release(const CellsOfParticle& cells) {
  for (const std::uint32_t number : cells.numbers) {
    if (number == none || --cells_[number].users > 0) continue;
    by_lowest_.erase(cells_[number].corners[0]);
    unused_.push_back(number);
  }
}

}  // namespace hyperlattice
