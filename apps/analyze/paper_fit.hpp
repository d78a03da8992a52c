// Calibration by the paper's polynomials (11) and (13), their range and the inverse of (11). They
// hold for one lattice: simple cubic, membrane I-m.
#pragma once

#include <analyze/membranes.hpp>

namespace hyperlattice::paper_fit {

/// Returns "" if the polynomials hold for this membrane and lattice; else the method to take
/// instead.
std::string instead(const LatticeGeometry& geometry, calibration::Membrane membrane);

/// Return "" if the value is in the range of the fit; else that range.
std::string range_of_poisson(double poisson);
std::string range_of_lambda(double lambda);

/// Returns the Poisson ratio at which equation (11) gives this lambda.
double poisson(double lambda);

}  // namespace hyperlattice::paper_fit
