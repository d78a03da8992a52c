#include <numerics/shared_disjoint_sets.hpp>
#include <state/fragments.hpp>

#include <algorithm>
#include <utility>

namespace hyperlattice {

namespace {

using SpringKey = std::pair<Particle, std::uint32_t>;  ///< first end and neighbour

/// Returns the springs that exist and do not join their ends, in ascending order.
std::vector<SpringKey> springs_that_join_nothing(const PresentSprings& springs, double damage) {
  std::vector<SpringKey> found;
  for (const WeakenedSpring& spring : springs.simulation().weakened_springs())
    if (!joins(spring.integrity, damage)) found.emplace_back(spring.a, spring.neighbour);
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

std::vector<double> fragments(const PresentSprings& springs, std::span<const double> masses,
                              double damage) {
  numerics::SharedDisjointSets sets(masses.size());
  const std::vector<SpringKey> loose = springs_that_join_nothing(springs, damage);
  springs.for_springs(Asked::motion, [&](const PresentSpring& spring) {
    const SpringKey key{spring.a, spring.neighbour};
    if (loose.empty() || !std::binary_search(loose.begin(), loose.end(), key))
      sets.join(spring.a, spring.b);
  });
  // The sums run in the order of the particles.
  std::vector<double> mass_of(masses.size(), 0);
  std::vector<Particle> roots;
  for (Particle p = 0; p < masses.size(); ++p) {
    const Particle root = sets.root(p);
    if (root == p) roots.push_back(p);
    mass_of[root] += masses[p];
  }
  std::stable_sort(roots.begin(), roots.end(),
                   [&](Particle a, Particle b) { return mass_of[a] > mass_of[b]; });
  std::vector<double>& number_of = mass_of;  // the masses are not needed any more
  for (std::size_t n = 0; n < roots.size(); ++n) number_of[roots[n]] = static_cast<double>(n);
  std::vector<double> numbers(masses.size());
  for (Particle p = 0; p < masses.size(); ++p) numbers[p] = number_of[sets.root(p)];
  return numbers;
}

}  // namespace hyperlattice
