// The choice of a membrane on the command line, and its checks.
#pragma once

#include <analyze/membranes.hpp>
#include <scene/json.hpp>

namespace hyperlattice {

/// The arguments of the command line; those not given are empty.
struct MembraneChoice {
  std::string membrane;
  std::optional<double> poisson, lambda;
  std::optional<std::string> k_alpha;  ///< a number, or "infinite"
  std::optional<double> k_beta, k_gamma;
};

/// A membrane with its stiffness ratios.
struct ChosenMembrane {
  calibration::Membrane membrane = calibration::Membrane::none;
  std::optional<double> lambda;  ///< empty for membranes without a lambda
  calibration::Ratios ratios;
  double volumetric = 0;  ///< K_v of the volumetric energy, k/l; only without a membrane
};

/// Returns the infinite lattice of a choice, with k = 1 N/m.
SpringLattice lattice_of(const ChosenMembrane& chosen, const LatticeGeometry& geometry);

/// Returns the membrane of this name; nothing, with a fault at --membrane, if there is none.
std::optional<calibration::Membrane> membrane_named(const std::string& name, Faults& faults);

/// Computes the stiffness ratios of a choice; without a membrane, the volumetric energy that its
/// Poisson ratio needs. Throws InputError with every fault. A lambda or
/// ratios of an unstable lattice are not a fault here: callers may want to analyse it.
ChosenMembrane resolve(const MembraneChoice& choice, const LatticeGeometry& geometry);

/// Returns the keys of the membrane for `--json`.
Json chosen_json(const ChosenMembrane& chosen);

}  // namespace hyperlattice
