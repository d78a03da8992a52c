#include <plan/coordination.hpp>

#include <algorithm>

namespace hyperlattice {

Coordination coordination_of(const Body& body) {
  constexpr std::uint32_t holding = 3;  // springs that are not in a plane hold a point
  std::vector<std::uint32_t> springs(body.particles, 0);
  for (const ListedSpring& spring : body.listed.springs) {
    ++springs[spring.a];
    ++springs[spring.b];
  }
  const auto [fewest, most] = std::minmax_element(springs.begin(), springs.end());
  return {*fewest, *most, static_cast<std::uint64_t>(std::count_if(springs.begin(), springs.end(), [](std::uint32_t n) { return n < holding; }))};
}

}  // namespace hyperlattice
