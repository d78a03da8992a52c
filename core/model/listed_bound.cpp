#include <model/critical_step.hpp>
#include <model/iterated_frequency.hpp>
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

std::vector<double> listed_bounds(const Model& model) {
  const Body& body = model.body;
  std::vector<StiffnessBound> sums(body.particles);
  for (std::uint32_t n = 0; n < body.listed.springs.size(); ++n) {
    const ListedSpring& spring = body.listed.springs[n];
    const SpringProperties properties = model.spring_properties(spring.a, spring.b, n);
    const SpringConstants constants{properties.stiffness, properties.cross_stiffness, infinity};
    sums[spring.a].add(geometry_of(properties), 1, constants, body.grid.membrane_distance,
                       model.springs.choice.membrane);
    sums[spring.b].add(geometry_of(properties), -1, constants, body.grid.membrane_distance,
                       model.springs.choice.membrane);
  }
  if (model.nodal_volumes) add_volumes(*model.nodal_volumes, sums);
  std::vector<double> bounds;
  bounds.reserve(body.particles);
  for (Particle p = 0; p < body.particles; ++p) {
    if (model.springs.choice.membrane == KernelChoice::Membrane::free) {
      const MaterialConstants& constants = model.materials[model.kinds.material(p)].constants;
      sums[p].add_alpha(body.share(p) * constants.alpha_ratio * constants.base_stiffness);
    }
    bounds.push_back(sums[p].value());
  }
  return bounds;
}

ListedBound listed_bound(const Model& model) {
  const Body& body = model.body;
  ListedBound found;
  for (std::uint32_t n = 0; n < body.listed.springs.size(); ++n) {
    const ListedSpring& spring = body.listed.springs[n];
    const SpringProperties properties = model.spring_properties(spring.a, spring.b, n);
    found.all_positive &= properties.stiffness > 0 && properties.cross_stiffness >= 0;
  }
  if (model.springs.choice.membrane == KernelChoice::Membrane::free)
    for (const Material& material : model.materials)
      found.all_positive &= material.constants.alpha_ratio >= 0;
  const std::vector<double> bounds = listed_bounds(model);
  for (Particle p = 0; p < body.particles; ++p)
    if (const double square = bounds[p] / model.mass(p); square > found.square) {
      found.square = square;
      found.particle = p;
    }
  return found;
}

double iterated_frequency_of_list(const Model& model) {
  const Body& body = model.body;
  const NodalVolumes& volumes = *model.nodal_volumes;
  // Unit vectors times the root of k.
  std::vector<Vec3> springs;
  springs.reserve(body.listed.springs.size());
  for (std::uint32_t n = 0; n < body.listed.springs.size(); ++n) {
    const ListedSpring& spring = body.listed.springs[n];
    const SpringProperties of = model.spring_properties(spring.a, spring.b, n);
    springs.push_back(std::sqrt(std::max(0.0, of.stiffness)) / of.rest_length * of.rest);
  }
  std::vector<std::vector<VolumeDerivative>> derivatives(body.particles);
  for (Particle p = 0; p < body.particles; ++p)
    if (volumes.modulus(p) != 0) derivatives[p] = volumes.derivatives(p);
  std::vector<double> scale;  // M^-1/2
  scale.reserve(body.particles);
  for (Particle p = 0; p < body.particles; ++p) scale.push_back(1 / std::sqrt(model.mass(p)));

  const auto times = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    const auto moved = [&](Particle p) {
      const Eigen::Index first = 3 * static_cast<Eigen::Index>(p);
      return scale[p] * Vec3{x[first], x[first + 1], x[first + 2]};
    };
    Eigen::VectorXd force = Eigen::VectorXd::Zero(x.size());
    const auto pull = [&](Particle p, Vec3 f) {
      for (Eigen::Index c = 0; c < 3; ++c)
        force[3 * static_cast<Eigen::Index>(p) + c] += scale[p] * f[c];
    };
    for (std::size_t n = 0; n < springs.size(); ++n) {
      const ListedSpring& spring = body.listed.springs[n];
      const Vec3 of = dot(springs[n], moved(spring.b) - moved(spring.a)) * springs[n];
      pull(spring.b, of);
      pull(spring.a, -of);
    }
    for (Particle p = 0; p < body.particles; ++p) {
      double growth = 0;
      for (const VolumeDerivative& of : derivatives[p])
        growth += dot(of.gradient, moved(of.particle));
      const double pressure =
          derivatives[p].empty() ? 0 : volumes.modulus(p) / volumes.rest_volume(p) * growth;
      for (const VolumeDerivative& of : derivatives[p]) pull(of.particle, pressure * of.gradient);
    }
    return force;
  };
  return frequency_by_iteration(3 * static_cast<Eigen::Index>(body.particles), times);
}

}  // namespace hyperlattice
