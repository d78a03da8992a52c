// Homogeneous deformations of bodies, and how far tensors differ.
#pragma once

#include <model/body.hpp>
#include <state/tensor.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace hyperlattice::test {

/// Returns the displacements H x of all particles, x from the origin.
inline std::vector<double> linear(const Body& body, const Tensor& H) {
  std::vector<double> u;
  u.reserve(3 * body.particles);
  for (Particle p = 0; p < body.particles; ++p) {
    const Vec3 d = H * body.position(p);
    u.insert(u.end(), {d.x, d.y, d.z});
  }
  return u;
}

/// Largest component; infinite if one is not a number.
inline double largest_component(const Symmetric& t) {
  double most = 0;
  for (const double x : t) most = std::isnan(x) ? HUGE_VAL : std::max(most, std::abs(x));
  return most;
}
inline double largest_difference(const Symmetric& a, const Symmetric& b) {
  Symmetric differences{};
  for (std::size_t n = 0; n < 6; ++n) differences[n] = a[n] - b[n];
  return largest_component(differences);
}
inline double largest_difference(const Tensor& a, const Tensor& b) {
  double most = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      most = std::isnan(a[i][j] - b[i][j]) ? HUGE_VAL : std::max(most, std::abs(a[i][j] - b[i][j]));
  return most;
}

}  // namespace hyperlattice::test
