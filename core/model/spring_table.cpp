#include <model/spring_table.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace hyperlattice {

void SpringTable::add_composite(std::size_t spring, CompositeSpring composite) {
  memory = std::max(memory, composite.memory());
  composite_of.resize(std::max(composite_of.size(), constants.size()), -1);
  composite_of[spring] = static_cast<std::int32_t>(composites.size());
  composites.push_back(std::move(composite));
}

std::vector<NeighbourGeometry> geometry_of(const Grid& grid) {
  std::vector<NeighbourGeometry> all;
  for (const Neighbour& n : grid.neighbours) {
    const Vec3 rest = grid.spacing * combined(grid.basis, n.dx, n.dy, n.dz);
    all.push_back({n, rest, norm(rest), std::hypot(norm(rest), grid.membrane_distance)});
  }
  return all;
}

}  // namespace hyperlattice
