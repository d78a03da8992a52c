// Springs whose stiffness the field of damage lowers.
#pragma once

#include <hyperlattice/plain.hpp>

#include <cstdint>

namespace hyperlattice {

/// A spring that the field computes. The stiffness of a cross spring has the factor, that of a base
/// spring too if it is stretched.
struct SoftSpring {
  Particle a = 0, b = 0;        ///< a is the first end
  std::uint32_t neighbour = 0;  ///< see Model::spring_properties
  double factor = 1;
};

/// A particle of which a part of the alpha spring remains.
struct SoftParticle {
  Particle particle = 0;
  double alpha_factor = 1;
};

}  // namespace hyperlattice
