#include <model/critical_step.hpp>

namespace hyperlattice {

namespace {

NeighbourGeometry geometry_of(const Joint& joint) { return {{}, joint.rest, joint.rest_length, joint.cross_rest_length}; }

}  // namespace

ListedBound listed_bound(const Model& model) {
  const Body& body = model.body;
  std::vector<StiffnessBound> sums(body.particles);
  ListedBound found;
  for (std::uint32_t n = 0; n < body.listed.springs.size(); ++n) {
    const ListedSpring& spring = body.listed.springs[n];
    const Joint joint = model.joint(spring.a, spring.b, n);
    found.all_positive &= joint.stiffness > 0 && joint.cross_stiffness >= 0;
    const SpringConstants constants{joint.stiffness, joint.cross_stiffness, infinity};
    sums[spring.a].add(geometry_of(joint), 1, constants, body.grid.membrane_distance, model.choice.membrane);
    sums[spring.b].add(geometry_of(joint), -1, constants, body.grid.membrane_distance, model.choice.membrane);
  }
  for (Particle p = 0; p < body.particles; ++p) {
    const MaterialConstants& constants = model.materials[model.material(p)].constants;
    if (model.choice.membrane == KernelChoice::Membrane::free) {
      sums[p].add_alpha(body.share(p) * constants.alpha_ratio * constants.base_stiffness);
      found.all_positive &= constants.alpha_ratio >= 0;
    }
    const double square = sums[p].value() / model.mass(p);
    if (square > found.square) found = {square, p, found.all_positive};
  }
  return found;
}

}  // namespace hyperlattice
