// Particles near supports, which take no damage: the clamping of a rim would start cracks.
#include <model/build.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hyperlattice {

namespace {

/// Returns 1 for each particle whose motion a load prescribes along an axis.
std::vector<std::uint8_t> supports(const Model& model) {
  std::vector<std::uint8_t> found;
  for (const Load& load : model.loads)
    for (const LoadedParticle& particle : load.particles) {
      if (particle.displaced == 0 && particle.driven == 0) continue;
      if (found.empty()) found.resize(model.body.particles);
      found[particle.particle] = 1;
    }
  return found;
}

/// Returns whether a particle has no neighbour along an axis that is no support. The particles
/// around it are then at least as near to another support.
bool is_inside(const Body& body, Site site, const std::vector<std::uint8_t>& supports) {
  constexpr Site steps[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (const Site step : steps) {
    const Particle next = body.at({site.i + step.i, site.j + step.j, site.k + step.k});
    if (next == Body::no_particle || supports[next] == 0) return false;
  }
  return true;
}

/// Calls mark(first, last + 1) for ranges of particles that are nearer than `radius` spacings to a
/// site.
template <class Mark>
void for_ball(const Body& body, Site centre, double radius, const Mark& mark) {
  const auto reach = static_cast<std::int32_t>(radius);
  for (std::int32_t k = -reach; k <= reach; ++k)
    for (std::int32_t j = -reach; j <= reach; ++j) {
      const double left = radius * radius - j * j - k * k;
      if (!(left > 0)) continue;
      // The largest whole number below the root.
      const auto most = static_cast<std::int32_t>(std::ceil(std::sqrt(left))) - 1;
      for (const Run& run : body.row(centre.j + j, centre.k + k)) {
        const std::int32_t begin = std::max(run.begin, centre.i - most),
                           end = std::min(run.end, centre.i + most + 1);
        if (begin < end)
          mark(run.first + static_cast<Particle>(begin - run.begin),
               run.first + static_cast<Particle>(end - run.begin));
      }
    }
}

}  // namespace

void set_intact(Model& model) {
  const auto has_zone = [](const Cohesive& of) {
    return of.stage != nullptr && of.intact_near_supports;
  };
  if (std::none_of(model.cohesive.begin(), model.cohesive.end(), has_zone)) return;
  const std::vector<std::uint8_t> held = supports(model);
  if (held.empty()) return;
  const Body& body = model.body;
  std::vector<std::uint8_t> intact(body.particles);
  for (Particle support = 0; support < body.particles; ++support) {
    if (held[support] == 0) continue;
    const Site site = body.site(support);
    if (const Cohesive& own = model.cohesive[model.kinds.material(support)]; has_zone(own))
      intact[support] = 1;
    if (is_inside(body, site, held)) continue;
    for (const Cohesive& of : model.cohesive) {
      if (!has_zone(of)) continue;
      for_ball(body, site, of.zone() / body.grid.spacing, [&](Particle first, Particle end) {
        for (Particle near = first; near < end; ++near)
          if (model.kinds.material(near) == of.material) intact[near] = 1;
      });
    }
  }
  model.intact = std::move(intact);
}

}  // namespace hyperlattice
