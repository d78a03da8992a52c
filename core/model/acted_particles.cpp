#include <host/plugin_call.hpp>
#include <model/acted_particles.hpp>

#include <spdlog/fmt/fmt.h>

namespace hyperlattice {

std::span<const Particle> ActedParticles::particles(LoadOrRegion of) {
  if (!of.is_load()) return regions_.particles(of.region);
  const auto load = static_cast<std::size_t>(of.load);
  if (load >= model_.loads.size())
    throw PluginMistake(
        fmt::format("it asks about load {}; there are {}", load, model_.loads.size()));
  const auto [found, is_new] = of_load_.try_emplace(load);
  if (is_new) found->second = model_.loads[load].acts_on(model_.body.particles);
  return found->second;
}

}  // namespace hyperlattice
