// A spring that has lost a part of its strength, and the rule by which springs join particles.
#pragma once

#include <hyperlattice/plain.hpp>

#include <cstdint>

namespace hyperlattice {

/// A base spring that exists and whose integrity is below 1.
struct WeakenedSpring {
  Particle a = 0, b = 0;        ///< a precedes b
  std::uint32_t neighbour = 0;  ///< see Model::spring_properties
  double integrity = 0;         ///< 0: it carries no tension any more
};

/// Returns whether a spring that exists joins its ends into one piece: if its damage, 1 -
/// integrity, is below a bound. Fragments and faces of cracks have this rule in common.
constexpr bool joins(double integrity, double damage) { return 1 - integrity < damage; }

}  // namespace hyperlattice
