#include <model/spring_calls.hpp>
#include <state/section_forces.hpp>

#include <hyperlattice/volumetric_cell.hpp>

namespace hyperlattice {

SectionForces::SectionForces(const BlockSet& blocks, const Clock& clock,
                             const NodalPressures& pressures, const DamageField& damage,
                             const PlaneSection& section)
    : blocks_(blocks),
      model_(blocks.model()),
      clock_(clock),
      pressures_(pressures),
      damage_(damage),
      tetrahedra_(section.tetrahedra) {
  constexpr std::size_t piece = 1024;  // springs
  for (std::size_t n = 0; n < section.springs.size(); ++n) {
    const CutSpring& cut = section.springs[n];
    if (n % piece == 0) pieces_.push_back(springs_.size());
    const Place place = blocks_.layout().place(cut.a);
    auto number = blocks_.layout().number_in_row(blocks_[place.block], place, cut.neighbour);
    if (!damage_.empty() && damage_.factor(cut.a, cut.neighbour)) number = cut.neighbour;
    if (!number) continue;
    springs_.push_back({end_of(cut.a), end_of(cut.b), place.row, *number, place.site, cut.neighbour,
                        cut.a_is_before});
  }
  pieces_.push_back(springs_.size());
  for (const CutCell& cut : section.cells) {
    Cell cell{{}, cut.modulus, cut.before};
    for (std::size_t n = 0; n < 8; ++n) cell.corners[n] = end_of(cut.corners[n]);
    cells_.push_back(cell);
  }
}

SectionForces::End SectionForces::end_of(Particle particle) const {
  const auto [block, index] = blocks_.at(particle);
  return {particle, block, index};
}

Vec3 SectionForces::moved(const End& end) {
  const auto number = [&](int c) { return end.block->displacement[c][end.index]; };
  return {number(0), number(1), number(2)};
}

/// Adds the forces of a cell on its corners before the plane.
void SectionForces::add(const Cell& cell, Vec3 about, Resultant& sum) const {
  const End& lowest = cell.corners.front();
  double remains = 1;
  if ((lowest.block->alive[lowest.index] & cell_bit) == 0) {
    const auto factor = damage_.empty() ? std::nullopt : damage_.cell_factor(lowest.particle);
    if (!factor) return;
    remains = *factor;
  }
  CellCorners displacement;
  for (std::size_t n = 0; n < 8; ++n) displacement[n] = moved(cell.corners[n]);
  const CellResponse own =
      soften(cell_response(displacement, model_.body.grid.spacing, cell.modulus), remains);
  for (std::size_t n = 0; n < 8; ++n) {
    if ((cell.before >> n & 1U) == 0) continue;
    const Vec3 place = model_.body.position(cell.corners[n].particle) + displacement[n];
    sum.force += own.force[n];
    sum.moment += cross(place - about, own.force[n]);
  }
}

/// Adds the forces of a tetrahedron on its corners before the plane.
void SectionForces::add(const CutTetrahedron& cut, Vec3 about, Resultant& sum) const {
  const Corners& corners = model_.nodal_volumes->tetrahedra()[cut.number];
  const std::array<Vec3, 4> forces = pressures_.forces(cut.number);
  for (std::size_t n = 0; n < 4; ++n) {
    if ((cut.before >> n & 1U) == 0) continue;
    const Vec3 place = model_.body.position(corners[n]) + moved(end_of(corners[n]));
    sum.force += forces[n];
    sum.moment += cross(place - about, forces[n]);
  }
}

/// Adds the force of a spring on its end before the plane.
void SectionForces::add(const Spring& spring, double remains, Vec3 about, Resultant& sum) const {
  const auto height = [this](const End& end) {
    return model_.degrees_of_freedom == 4 ? end.block->displacement[3][end.index] : 0;
  };
  const SpringProperties of =
      model_.spring_properties(spring.a.particle, spring.b.particle, spring.neighbour);
  const Vec3 apart = moved(spring.b) - moved(spring.a);
  const double pull =
      pull_of(
          model_, of, {apart, height(spring.a), height(spring.b)}, clock_.last_step(),
          [&](std::size_t cross) {
            return blocks_.law_numbers(*spring.a.block, spring.row, spring.number, spring.site,
                                       cross != 0);
          },
          remains)
          .pull;
  const End& before = spring.a_is_before ? spring.a : spring.b;
  const Vec3 force = ((spring.a_is_before ? of.share : -of.share) * pull) * (of.rest + apart);
  sum.force += force;
  sum.moment += cross(model_.body.position(before.particle) + moved(before) - about, force);
}

/// Returns what damage leaves of a spring, 1 without damage; nothing if the spring is broken.
std::optional<double> SectionForces::remaining(const Spring& spring) const {
  const Place first{spring.a.block->number, spring.row, spring.site, spring.a.index};
  if (blocks_.layout().exists(*spring.a.block, first, spring.number)) return 1;
  if (damage_.empty()) return std::nullopt;
  return damage_.factor(spring.a.particle, spring.neighbour);
}

Resultant SectionForces::sum(Vec3 about) const {
  std::vector<Resultant> parts(pieces_.size() - 1);
  blocks_.team().for_each(parts.size(), [&](std::size_t n) {
    for (std::size_t s = pieces_[n]; s < pieces_[n + 1]; ++s) {
      if (const auto remains = remaining(springs_[s])) add(springs_[s], *remains, about, parts[n]);
    }
  });
  Resultant total;
  for (const Cell& cell : cells_) add(cell, about, total);
  for (const CutTetrahedron& cut : tetrahedra_) add(cut, about, total);
  for (const Resultant& part : parts) {
    total.force += part.force;
    total.moment += part.moment;
  }
  return total;
}

}  // namespace hyperlattice
