#include <model/build.hpp>
#include <model/cut_faces.hpp>
#include <model/load_view.hpp>

namespace hyperlattice {

namespace {

/// Returns the distance from a particle to the shape, see LoadBody::gap().
double gap_to_shape(const Body& body, Particle particle, Vec3 direction) {
  if (body.grid.boundary != Boundary::partial_cells || body.grid.shape == nullptr) return 0;
  const Shape& shape = *body.grid.shape;
  const Vec3 start = body.position(particle);
  const double spacing = body.grid.spacing;
  constexpr double rounding = 1e-6;
  for (const Vec3 normal : face_normals)
    if (shape.contains(start) || shape.contains(start + rounding * spacing * normal)) return 0;
  constexpr int steps = 64, halvings = 20;
  double outside = 0, inside = infinity;
  for (int n = 1; n <= steps && inside == infinity; ++n) {
    const double far = 2 * spacing * n / steps;
    (shape.contains(start + far * direction) ? inside : outside) = far;
  }
  for (int n = 0; n < halvings && inside < infinity; ++n) {
    const double middle = 0.5 * (outside + inside);
    (shape.contains(start + middle * direction) ? inside : outside) = middle;
  }
  return inside;
}

}  // namespace

std::span<const Particle> LoadView::particles(RegionId region) {
  const std::span<const Particle> found = regions_.particles(region);
  if (found.empty()) empty = region;
  return found;
}

Particle LoadView::existing(Particle particle) const {
  if (particle >= model_.body.particles)
    throw PluginMistake("it asks about a particle that does not exist");
  return particle;
}

std::span<const RestSpring> LoadView::springs(RegionId region) {
  const auto [found, is_new] = springs_.try_emplace(region.index);
  springs_unknown |= model_.springs.constants.empty();
  if (is_new && !springs_unknown) found->second = springs_at(model_, particles(region));
  return found->second;
}

std::span<const SeveredSpring> LoadView::cut_springs(RegionId region) {
  const auto [found, is_new] = cut_springs_.try_emplace(region.index);
  springs_unknown |= model_.springs.constants.empty();
  if (!is_new || springs_unknown || particles(region).empty()) return found->second;
  const auto refuse = [&](const std::string& expected) {
    throw InputError({{stage_.pointer, stage_.component->type(), expected}});
  };
  if (const char* expected = expected_of_closed_cuts(model_)) refuse(expected);
  found->second = cut_springs_in(model_, regions_, particles(region));
  if (found->second.empty())
    refuse("a region that a cut of the lattice passes through, with particles on both sides");
  for (const SeveredSpring& spring : found->second)
    if (!taken_.insert(std::minmax(spring.a, spring.b)).second)
      refuse("a region whose cuts no other load closes");
  return found->second;
}

LoadBody LoadView::body() {
  LoadBody seen;
  seen.self = this;
  seen.spacing = model_.body.grid.spacing;
  seen.rim = model_.body.cells.empty() ? 0.5 * model_.body.grid.spacing : 0;
  seen.region_particles = [](void* self, RegionId region) noexcept {
    return answer(self, std::span<const Particle>(),
                  [&](LoadView& view) { return view.particles(region); });
  };
  seen.particle_position = [](void* self, Particle particle) noexcept {
    return answer(self, Vec3(), [&](LoadView& view) {
      return view.model_.body.position(view.existing(particle));
    });
  };
  seen.particle_mass = [](void* self, Particle particle) noexcept {
    return answer(self, 0.0, [&](LoadView& view) {
      // Masses are missing only if the materials have faults; then nothing runs.
      return view.model_.kinds.masses.empty() ? 0 : view.model_.mass(view.existing(particle));
    });
  };
  seen.particle_share = [](void* self, Particle particle) noexcept {
    return answer(self, 1.0,
                  [&](LoadView& view) { return view.model_.body.share(view.existing(particle)); });
  };
  seen.region_open_areas = [](void* self, RegionId region) noexcept {
    return answer(self, std::span<const OpenArea>(), [&](LoadView& view) {
      return view.particles(region).empty() ? std::span<const OpenArea>()
                                            : view.regions_.open_areas(region);
    });
  };
  seen.region_true_area = [](void* self, RegionId region) noexcept {
    return answer(self, 0.0, [&](LoadView& view) { return view.regions_.true_area(region); });
  };
  seen.region_centre = [](void* self, RegionId region) noexcept {
    return answer(self, Vec3(), [&](LoadView& view) { return view.regions_.centre(region); });
  };
  seen.particle_gap = [](void* self, Particle particle, Vec3 direction) noexcept {
    return answer(self, 0.0, [&](LoadView& view) {
      return gap_to_shape(view.model_.body, view.existing(particle), direction);
    });
  };
  seen.region_springs = [](void* self, RegionId region) noexcept {
    return answer(self, std::span<const RestSpring>(),
                  [&](LoadView& view) { return view.springs(region); });
  };
  seen.region_cut_springs = [](void* self, RegionId region) noexcept {
    return answer(self, std::span<const SeveredSpring>(),
                  [&](LoadView& view) { return view.cut_springs(region); });
  };
  return seen;
}

}  // namespace hyperlattice
