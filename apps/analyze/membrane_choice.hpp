// The membrane of a lattice as a user chooses it, and what is wrong with the choice.
#pragma once

#include <analyze/membranes.hpp>
#include <scene/json.hpp>

namespace hyperlattice {

/// As written on a command line; what was not given is empty.
struct MembraneChoice {
  std::string membrane;
  std::optional<double> poisson, lambda;
  std::optional<std::string> k_alpha;  ///< a number, or "infinite"
  std::optional<double> k_beta, k_gamma;
};

struct ChosenMembrane {
  calibration::Membrane membrane = calibration::Membrane::none;
  std::optional<double> lambda;  ///< of membranes that have one
  calibration::Ratios ratios;
};

/// Empty, and a fault at --membrane, if there is none of that name.
std::optional<calibration::Membrane> membrane_named(const std::string& name, Faults& faults);

/// Throws InputError with every fault. A lambda or ratios that make an unstable lattice are no
/// fault: to find that out is what one asks for.
ChosenMembrane resolve(const MembraneChoice& choice, const LatticeGeometry& geometry);

/// Its keys for `--json`.
Json chosen_json(const ChosenMembrane& chosen);

}  // namespace hyperlattice
