// Particles near supports, which take no damage: the clamping of a rim would start cracks.
#include <model/build.hpp>

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

/// Marks the particles nearer than `radius` spacings to a site.
template <class Mark>
void for_ball(const Body& body, Site centre, double radius, const Mark& mark) {
  const auto reach = static_cast<std::int32_t>(radius);
  for (std::int32_t k = -reach; k <= reach; ++k)
    for (std::int32_t j = -reach; j <= reach; ++j) {
      const double left = radius * radius - j * j - k * k;
      if (left < 0) continue;
      const auto most = static_cast<std::int32_t>(std::sqrt(left));
      for (std::int32_t i = -most; i <= most; ++i) {
        const Particle found = body.at({centre.i + i, centre.j + j, centre.k + k});
        if (found != Body::no_particle) mark(found);
      }
    }
}

}  // namespace

void set_intact(Model& model) {
  double radius = 0;
  for (const Cohesive& of : model.cohesive)
    if (of.stage != nullptr && of.intact_near_supports) radius = std::max(radius, of.zone());
  if (radius == 0) return;
  const std::vector<std::uint8_t> held = supports(model);
  if (held.empty()) return;
  const Body& body = model.body;
  std::vector<std::uint8_t> intact(body.particles);
  for (Particle support = 0; support < body.particles; ++support) {
    if (held[support] == 0) continue;
    const Site site = body.site(support);
    const double reach = is_inside(body, site, held) ? 0 : radius / body.grid.spacing;
    for_ball(body, site, reach, [&](Particle near) {
      const Cohesive& of = model.cohesive[model.kinds.material(near)];
      if (of.stage == nullptr || !of.intact_near_supports) return;
      const double distance = norm(body.position(near) - body.position(support));
      if (distance < of.zone()) intact[near] = 1;
    });
  }
  model.intact = std::move(intact);
}

}  // namespace hyperlattice
