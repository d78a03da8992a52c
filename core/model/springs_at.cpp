#include <model/build.hpp>

#include <algorithm>

namespace hyperlattice {

namespace {

RestSpring rest_spring(const Model& model, Particle a, Particle b, std::uint32_t neighbour) {
  const SpringProperties properties = model.spring_properties(a, b, neighbour);
  RestSpring spring;
  spring.a = a;
  spring.b = b;
  spring.stiffness = properties.share * properties.stiffness;
  spring.share = properties.share;
  spring.rest_length = properties.rest_length;
  spring.breakable = model.springs.breakable && model.alarm(a, b, neighbour, properties) < infinity;
  return spring;
}

}  // namespace

std::vector<RestSpring> springs_at(const Model& model, std::span<const Particle> particles) {
  const Body& body = model.body;
  std::vector<RestSpring> found;
  const auto among = [&](Particle particle) {
    return std::binary_search(particles.begin(), particles.end(), particle);
  };
  for (std::uint32_t n = 0; n < body.listed.springs.size(); ++n) {
    const ListedSpring& spring = body.listed.springs[n];
    if (among(spring.a) || among(spring.b))
      found.push_back(rest_spring(model, spring.a, spring.b, n));
  }
  if (body.is_listed()) return found;
  for (const Particle particle : particles)
    for (std::uint32_t n = 0; n < body.neighbours.size(); ++n) {
      const Neighbour& to = body.neighbours[n];
      const Site here = body.site(particle), before{here.i - to.dx, here.j - to.dy, here.k - to.dz};
      const Particle next = body.at({here.i + to.dx, here.j + to.dy, here.k + to.dz}),
                     previous = body.at(before);
      if (next != Body::no_particle && body.share(here, to) > 0 && !body.is_cut(particle, n))
        found.push_back(rest_spring(model, particle, next, n));
      if (previous != Body::no_particle && body.share(before, to) > 0 && !among(previous) &&
          !body.is_cut(previous, n))
        found.push_back(rest_spring(model, previous, particle, n));
    }
  std::sort(found.begin(), found.end(), [](const RestSpring& l, const RestSpring& r) {
    return l.a != r.a ? l.a < r.a : l.b < r.b;
  });
  return found;
}

}  // namespace hyperlattice
