#include <analyze/membranes.hpp>

namespace hyperlattice {

using calibration::Membrane;

SpringLattice with_ratios(const LatticeGeometry& geometry, const calibration::Ratios& ratios,
                          double volumetric) {
  MaterialConstants constants = membranes::constants(facts_of(geometry), ratios);
  constants.volumetric = volumetric * constants.base_stiffness / geometry.spacing;
  return {geometry, constants};
}

calibration::Ratios ratios_of(const LatticeGeometry& geometry, Membrane membrane, double lambda) {
  return membranes::ratios(facts_of(geometry), membrane, lambda);
}

std::optional<double> lambda_for(const LatticeGeometry& geometry, Membrane membrane,
                                 double poisson) {
  if (!has_lambda(membrane)) return std::nullopt;
  return membranes::lambda(facts_of(geometry), membrane, poisson);
}

std::optional<calibration::Reach> reach(const LatticeGeometry& geometry, Membrane membrane) {
  if (!has_lambda(membrane)) return std::nullopt;
  return membranes::reach(facts_of(geometry), membrane);
}

bool is_stable(const LatticeGeometry& geometry, Membrane membrane, double lambda) {
  return membranes::is_stable(facts_of(geometry), membrane, lambda);
}

std::string stable_sentence(const LatticeGeometry& geometry, Membrane membrane, double lambda) {
  return membranes::stable_sentence(facts_of(geometry), membrane, lambda);
}

std::string reach_sentence(const LatticeGeometry& geometry, Membrane membrane, double poisson) {
  return membranes::reach_sentence(facts_of(geometry), membrane, poisson);
}

}  // namespace hyperlattice
