#include <host/plugin_call.hpp>
#include <model/build.hpp>
#include <model/homogenise.hpp>
#include <model/spring_lattice.hpp>
#include <model/stability.hpp>

namespace hyperlattice {

namespace {

using Membrane = KernelChoice::Membrane;

Membrane membrane_of(const MaterialConstants& constants) {
  if (constants.clamped) return constants.has_cross_springs() ? Membrane::clamped : Membrane::none;
  return constants.has_cross_springs() || constants.alpha_ratio != 0 ? Membrane::free
                                                                     : Membrane::none;
}

/// Returns NaN if the springs make no solid: a plugin calls this, and no exception may cross its
/// library.
ElasticConstants list_constants(const LatticeGeometry& of,
                                const MaterialConstants& constants) noexcept {
  try {
    return homogenise(*of.listed, of.volume, of.membrane_distance, constants);
  } catch (...) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    return {none, none, none};
  }
}

}  // namespace

LatticeGeometry geometry_from(const Grid& grid) {
  return {geometry_of(grid),
          grid.spring_classes,
          grid.spacing,
          grid.site_volume,
          grid.membrane_distance,
          grid.basis,
          grid.class_stiffness,
          {},
          0};
}

LatticeGeometry geometry_from(const Body& body) {
  LatticeGeometry geometry = geometry_from(body.grid);
  if (!body.is_listed()) return geometry;
  geometry.listed = {std::shared_ptr<void>(), &body.listed};  // no owner
  for (Particle p = 0; p < body.particles; ++p)
    geometry.volume += body.share(p) * body.grid.site_volume;
  return geometry;
}

SpringLattice::SpringLattice(LatticeGeometry geometry, const MaterialConstants& constants)
    : geometry_(std::move(geometry)), constants_(constants), membrane_(membrane_of(constants)) {
  for (std::uint32_t c = 0; c < geometry_.spring_classes; ++c)
    springs_.push_back({geometry_.class_stiffness[c] * constants.base_stiffness,
                        constants.cross_ratio[c] * constants.base_stiffness, infinity});
  alpha_ = constants.clamped ? 0 : constants.alpha_ratio * constants.base_stiffness;
}

InfiniteLattice SpringLattice::endless() const {
  return {geometry_.neighbours,
          springs_,
          alpha_,
          geometry_.membrane_distance,
          membrane_,
          geometry_.spacing,
          geometry_.basis,
          constants_.volumetric};
}

double largest_energy(const MaterialConstants& constants, double spacing) {
  double ratio = constants.clamped ? 1 : std::max(1.0, std::abs(constants.alpha_ratio));
  for (const double cross : constants.cross_ratio) ratio = std::max(ratio, std::abs(cross));
  return ratio * constants.base_stiffness * spacing * spacing;
}

LatticeFacts facts_of(const LatticeGeometry& geometry) {
  LatticeFacts facts;
  facts.spacing = geometry.spacing;
  facts.basis = geometry.basis;
  facts.site_volume = geometry.site_volume;
  facts.membrane_distance = geometry.membrane_distance;
  facts.spring_classes = geometry.spring_classes;
  facts.class_stiffness = geometry.class_stiffness;
  // The bit of the cell is one of the bits of a site. A list has tetrahedra.
  facts.has_cells = geometry.listed ||
                    (geometry.basis == cubic_basis && geometry.neighbours.size() < max_neighbours);
  facts.self = const_cast<LatticeGeometry*>(&geometry);  // only read
  facts.get_elastic_constants = [](void* self, const MaterialConstants& constants) noexcept {
    return PluginCall::answer(ElasticConstants(), [&] {
      const auto& of = *static_cast<const LatticeGeometry*>(self);
      if (of.listed) return list_constants(of, constants);
      return mean_constants(
          layer_stiffness(SpringLattice(of, constants).endless(), of.site_volume));
    });
  };
  facts.get_stable = [](void* self, const MaterialConstants& constants) noexcept {
    return PluginCall::answer(false, [&] {
      const auto& of = *static_cast<const LatticeGeometry*>(self);
      // A list counts as stable only without negative springs: no wave analysis exists for it.
      if (of.listed)
        return constants.cross_ratio[0] >= 0 && (constants.clamped || constants.alpha_ratio >= 0);
      return largest_energy(constants, of.spacing) <= most_energy &&
             !find_instability(SpringLattice(of, constants).endless(), Sector::mirrored);
    });
  };
  return facts;
}

}  // namespace hyperlattice
