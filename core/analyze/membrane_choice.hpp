// The membrane of a lattice as a user chooses it, and what is wrong with the choice.
#pragma once

#include <analyze/membranes.hpp>

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

/// Throws InputError with every fault. A lambda or ratios that make an unstable lattice are no fault: to find that out is what one asks for.
ChosenMembrane resolve(const MembraneChoice& choice, const LatticeGeometry& geometry);

}  // namespace hyperlattice
