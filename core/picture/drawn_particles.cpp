#include <picture/drawn_particles.hpp>

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace hyperlattice::picture {

std::vector<Particle> drawn_particles(const OutputContext& context, RegionId region,
                                      const std::optional<RegionId>& cut) {
  const auto whole = context.particles(region);
  if (whole.empty()) throw std::runtime_error("no particle lies in the region");
  std::vector<Particle> drawn(whole.begin(), whole.end());
  if (!cut) return drawn;
  const auto away = context.particles(*cut);
  std::vector<Particle> left;
  std::set_difference(drawn.begin(), drawn.end(), away.begin(), away.end(),
                      std::back_inserter(left));
  if (left.empty()) throw std::runtime_error("the cut takes every particle away");
  return left;
}

}  // namespace hyperlattice::picture
