// The highest frequency of a body, found by iteration with its stiffness matrix.
#pragma once

#include <numerics/lanczos.hpp>

#include <hyperlattice/chance.hpp>

#include <cmath>
#include <cstdint>

namespace hyperlattice {

/// Returns the highest frequency omega, 1/s, increased by 2 %: 25 products find it from below.
/// times(x): M^-1/2 K M^-1/2 x, 1/s2, of a vector with this many numbers.
template <class Times>
double frequency_by_iteration(Eigen::Index numbers, const Times& times) {
  constexpr int products = 25;
  constexpr double margin = 1.02;
  Eigen::VectorXd start(numbers);
  for (Eigen::Index n = 0; n < numbers; ++n)
    start[n] = chance(0, static_cast<std::uint64_t>(n), 0) - 0.5;
  return margin * std::sqrt(numerics::lanczos_largest(std::move(start), products, times));
}

}  // namespace hyperlattice
