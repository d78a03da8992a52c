#include <model/build.hpp>
#include <model/spring_lattice.hpp>
#include <model/stability.hpp>

namespace hyperlattice {

namespace {

using Membrane = KernelChoice::Membrane;

Membrane membrane_of(const MaterialConstants& constants) {
  if (constants.clamped) return constants.has_cross_springs() ? Membrane::clamped : Membrane::none;
  return constants.has_cross_springs() || constants.alpha_ratio != 0 ? Membrane::free : Membrane::none;
}

}  // namespace

LatticeGeometry geometry_from(const Grid& grid) {
  return {geometry_of(grid), grid.spring_classes, grid.spacing, grid.site_volume, grid.membrane_distance, grid.basis, grid.class_stiffness};
}

SpringLattice::SpringLattice(LatticeGeometry geometry, const MaterialConstants& constants)
    : geometry_(std::move(geometry)), base_stiffness_(constants.base_stiffness), membrane_(membrane_of(constants)) {
  for (std::uint32_t c = 0; c < geometry_.spring_classes; ++c)
    springs_.push_back({geometry_.class_stiffness[c] * base_stiffness_, constants.cross_ratio[c] * base_stiffness_, infinity});
  alpha_ = constants.clamped ? 0 : constants.alpha_ratio * base_stiffness_;
}

InfiniteLattice SpringLattice::endless() const {
  return {geometry_.neighbours, springs_, alpha_, geometry_.membrane_distance, membrane_, geometry_.spacing, geometry_.basis};
}

LatticeFacts facts_of(const LatticeGeometry& geometry) {
  LatticeFacts facts;
  facts.spacing = geometry.spacing;
  facts.basis = geometry.basis;
  facts.site_volume = geometry.site_volume;
  facts.membrane_distance = geometry.membrane_distance;
  facts.spring_classes = geometry.spring_classes;
  facts.class_stiffness = geometry.class_stiffness;
  facts.self = const_cast<LatticeGeometry*>(&geometry);  // only read
  facts.get_elastic_constants = [](void* self, const MaterialConstants& constants) {
    const auto& of = *static_cast<const LatticeGeometry*>(self);
    return mean_constants(layer_stiffness(SpringLattice(of, constants).endless(), of.site_volume));
  };
  facts.get_stable = [](void* self, const MaterialConstants& constants) {
    return !find_instability(SpringLattice(*static_cast<const LatticeGeometry*>(self), constants).endless(), Sector::mirrored);
  };
  return facts;
}

}  // namespace hyperlattice
