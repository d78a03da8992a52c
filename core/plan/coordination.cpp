#include <plan/coordination.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>

namespace hyperlattice {

Coordination coordination_of(const Body& body) {
  constexpr std::uint32_t holding = 3;  // springs that are not in a plane hold a particle
  std::vector<std::uint32_t> springs(body.particles, 0);
  for (const ListedSpring& spring : body.listed.springs) {
    ++springs[spring.a];
    ++springs[spring.b];
  }
  const auto [fewest, most] = std::minmax_element(springs.begin(), springs.end());
  return {*fewest, *most,
          static_cast<std::uint64_t>(std::count_if(springs.begin(), springs.end(),
                                                   [](std::uint32_t n) { return n < holding; }))};
}

std::string coordination_warning(const Body& body) {
  // A body of fewer particles is mostly surface: with few springs per particle it may still be
  // stiff, if it is laid out in order.
  constexpr double mostly_surface = 100;
  const double particles = static_cast<double>(body.particles),
               springs = static_cast<double>(body.listed.springs.size());
  const double mean = 2 * springs / particles, least = 3 * particles - 6;
  if (springs < least)
    return fmt::format(
        "the body's springs do not hold it: it has {:.0f}, {:.3g} a particle on the mean, and {} "
        "particles in space are held by {:.0f} at least, "
        "about 6 a particle; it gives way without resistance, whatever E and nu are: expected a "
        "mean coordination of {:g} or more",
        springs, mean, body.particles, least, stiff_coordination);
  const bool may_be_in_order = body.listed.sample_particles == 0;
  if (springs + 0.5 >= stiff_coordination / 2 * particles ||
      (may_be_in_order && particles < mostly_surface))
    return "";
  return fmt::format(
      "the body has {:.3g} springs a particle on the mean, hardly more than the 6 that hold "
      "particles in space: {}how stiff it comes out is left to "
      "chance, from nearly nothing to more than E: expected a mean coordination of {:g} or more",
      mean, may_be_in_order ? "unless they stand in an order, " : "", stiff_coordination);
}

}  // namespace hyperlattice
