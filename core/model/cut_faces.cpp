#include <model/cut_faces.hpp>
#include <model/cut_springs.hpp>

#include <algorithm>
#include <map>
#include <optional>

namespace hyperlattice {

namespace {

/// Sets the normal and the crossing of a spring where a flat piece crosses it.
void meet(SeveredSpring& spring, Vec3 from, const FlatPiece& piece) {
  const double along = dot(spring.rest, piece.normal), height = piece.height(from);
  if (along < 0) {
    // The spring starts on the side of the normal: it gets the other direction.
    std::swap(spring.a, spring.b);
    spring.crossing = from + std::clamp(-height / along, 0.0, 1.0) * spring.rest;
    spring.rest = -spring.rest;
  } else {
    spring.crossing = from + std::clamp(along > 0 ? -height / along : 0.5, 0.0, 1.0) * spring.rest;
  }
  spring.normal = piece.normal;
}

/// Gives springs across the border of a region the direction out of it, and the mean direction of
/// the springs of their inner end as normal.
class Border {
 public:
  Border(RegionIndex& regions, RegionId region) : inside_(regions.particles(region)) {}

  bool has(Particle particle) const {
    return std::binary_search(inside_.begin(), inside_.end(), particle);
  }
  bool separates(const SeveredSpring& spring) const { return has(spring.a) != has(spring.b); }
  void turn(SeveredSpring& spring) {
    if (!has(spring.a)) {
      std::swap(spring.a, spring.b);
      spring.rest = -spring.rest;
    }
    outwards_[spring.a] += spring.stiffness * spring.rest;
  }
  Vec3 normal(const SeveredSpring& spring) const {
    const Vec3 mean = outwards_.at(spring.a);
    return norm(mean) > 0 ? direction_of(mean) : direction_of(spring.rest);
  }

 private:
  std::span<const Particle> inside_;
  std::map<Particle, Vec3> outwards_;
};

}  // namespace

const char* expected_of_closed_cuts(const Model& model) {
  if (model.body.is_listed()) return "a lattice on a grid: cuts of lists cannot be closed";
  if (model.springs.choice.membrane != KernelChoice::Membrane::none)
    return "materials with \"membrane\": \"none\": the cross springs of a cut cannot be closed";
  if (!model.volumetric.empty())
    return "materials without volumetric energy (the Poisson ratio of the springs alone): that of "
           "the cells of a cut cannot be closed";
  return nullptr;
}

std::vector<SeveredSpring> cut_springs_in(const Model& model, RegionIndex& regions,
                                          std::span<const Particle> particles) {
  const Body& body = model.body;
  std::vector<SeveredSpring> springs;
  std::vector<Segment> segments;
  const auto among = [&](Particle particle) {
    return std::binary_search(particles.begin(), particles.end(), particle);
  };
  body.for_cut_springs([&](Particle a, Particle b, std::uint32_t neighbour) {
    if (!among(a) || !among(b)) return;
    const SpringProperties properties = model.spring_properties(a, b, neighbour);
    springs.push_back({a, b, properties.share * properties.stiffness, properties.rest, {}, {}});
    segments.push_back({a, b});
  });
  std::vector<bool> is_known(springs.size(), false);
  for (const Cut& cut : model.scene->of(Family::lattices).front()->cuts) {
    if (cut.surface.border_of) {
      Border border(regions, *cut.surface.border_of);
      std::vector<std::size_t> own;
      for (std::size_t n = 0; n < springs.size(); ++n) {
        if (is_known[n] || !border.separates(springs[n])) continue;
        is_known[n] = true;
        springs[n].crossing = body.position(springs[n].a) + 0.5 * springs[n].rest;
        border.turn(springs[n]);
        own.push_back(n);
      }
      for (const std::size_t n : own) springs[n].normal = border.normal(springs[n]);
    }
    for_crossings(body, cut, segments, [&](std::size_t n, const FlatPiece& piece) {
      if (is_known[n]) return;
      is_known[n] = true;
      meet(springs[n], body.position(springs[n].a), piece);
    });
  }
  // Round-off may decide otherwise about a crossing on the rim of a surface.
  std::size_t kept = 0;
  for (std::size_t n = 0; n < springs.size(); ++n)
    if (is_known[n]) springs[kept++] = springs[n];
  springs.resize(kept);
  return springs;
}

}  // namespace hyperlattice
