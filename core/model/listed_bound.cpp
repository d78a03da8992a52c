#include <model/critical_step.hpp>
#include <model/nodal_volumes.hpp>

namespace hyperlattice {

namespace {

NeighbourGeometry geometry_of(const SpringProperties& properties) {
  return {{}, properties.rest, properties.rest_length, properties.cross_rest_length};
}

void add_volumes(const NodalVolumes& volumes, std::vector<StiffnessBound>& sums) {
  for (Particle p = 0; p < sums.size(); ++p) {
    if (volumes.modulus(p) == 0) continue;
    const std::vector<VolumeDerivative> derivatives = volumes.derivatives(p);
    double size = 0;
    for (const VolumeDerivative& of : derivatives) size += norm(of.gradient);
    for (const VolumeDerivative& of : derivatives)
      if (const double own = norm(of.gradient); own > 0)
        sums[of.particle].add_part(volumes.modulus(p) / volumes.rest_volume(p) * size * own,
                                   of.gradient);
  }
}

}  // namespace

ListedBound listed_bound(const Model& model) {
  const Body& body = model.body;
  std::vector<StiffnessBound> sums(body.particles);
  ListedBound found;
  for (std::uint32_t n = 0; n < body.listed.springs.size(); ++n) {
    const ListedSpring& spring = body.listed.springs[n];
    const SpringProperties properties = model.spring_properties(spring.a, spring.b, n);
    found.all_positive &= properties.stiffness > 0 && properties.cross_stiffness >= 0;
    const SpringConstants constants{properties.stiffness, properties.cross_stiffness, infinity};
    sums[spring.a].add(geometry_of(properties), 1, constants, body.grid.membrane_distance,
                       model.springs.choice.membrane);
    sums[spring.b].add(geometry_of(properties), -1, constants, body.grid.membrane_distance,
                       model.springs.choice.membrane);
  }
  if (model.nodal_volumes) add_volumes(*model.nodal_volumes, sums);
  for (Particle p = 0; p < body.particles; ++p) {
    const MaterialConstants& constants = model.materials[model.kinds.material(p)].constants;
    if (model.springs.choice.membrane == KernelChoice::Membrane::free) {
      sums[p].add_alpha(body.share(p) * constants.alpha_ratio * constants.base_stiffness);
      found.all_positive &= constants.alpha_ratio >= 0;
    }
    const double square = sums[p].value() / model.mass(p);
    if (square > found.square) found = {square, p, found.all_positive};
  }
  return found;
}

}  // namespace hyperlattice
