// The strain of each particle, from the displacements alone. See docs/theory/stress.md.
#pragma once

#include <state/present_springs.hpp>
#include <state/tensor.hpp>

namespace hyperlattice {

/// Returns the gradient, 1/m times its unit, with respect to the place at rest, of a field with
/// x y z of each particle. Of displacements it is H = F - 1. It is the mean over the whole cells
/// around a particle. A particle without one, and each particle of a lattice without cubic cells,
/// has a fit to its springs that are not broken by least squares,
///   (sum w f (x) R) (sum w R (x) R)^-1,  f the difference at the spring's ends, R the spring at
/// rest, w its share; NaN if the springs lie nearly in a plane. Exact for linear fields.
std::vector<Tensor> gradients(const PresentSprings& springs, std::span<const double> xyz);

/// Returns the Green-Lagrange strain E = (H + H^T + H^T H) / 2, without cancellation.
Symmetric green_lagrange_strain(const Tensor& H);
/// Returns the Hencky strain ln(F^T F) / 2. Its trace is ln J. NaN if J = 0.
Symmetric hencky_strain(const Tensor& H);
/// Returns the rate of strain, 1/s, the symmetric part of (dF/dt) F^-1. NaN if J = 0.
Symmetric strain_rate(const Tensor& H, const Tensor& H_per_second);

/// Eigenvalues of a symmetric tensor in descending order, and their directions: row n belongs to
/// value n. The largest component of a direction is positive.
struct Principal {
  Vec3 values;
  Tensor directions;
};
/// NaN if a number of the tensor is not finite.
Principal principal(const Symmetric& tensor);

}  // namespace hyperlattice
