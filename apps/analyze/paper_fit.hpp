// The paper's polynomials (11) and (13), a method of calibration for one lattice: simple cubic,
// membrane I-m. With their range, and backwards.
#pragma once

#include <analyze/membranes.hpp>

namespace hyperlattice::paper_fit {

/// "" if this membrane of this lattice is the one that was fitted; else what to take instead.
std::string instead(const LatticeGeometry& geometry, calibration::Membrane membrane);

/// "" if within the fit's range; else that range.
std::string range_of_poisson(double poisson);
std::string range_of_lambda(double lambda);

/// The Poisson ratio at which equation (11) gives this lambda.
double poisson(double lambda);

}  // namespace hyperlattice::paper_fit
