// Vectors as text for messages.
#pragma once

#include <hyperlattice/files.hpp>
#include <hyperlattice/plain.hpp>

namespace hyperlattice::equilibrium {

inline std::string short_vector(Vec3 v, int digits = 4) {
  return "(" + short_number(v.x, digits) + ", " + short_number(v.y, digits) + ", " +
         short_number(v.z, digits) + ")";
}

/// Returns the direction of a vector as a unit vector with two decimal places.
inline std::string direction_text(Vec3 v) {
  const auto rounded = [length = norm(v)](double value) {
    return std::round(100 * value / length) / 100 + 0.0;
  };
  return short_vector({rounded(v.x), rounded(v.y), rounded(v.z)});
}

}  // namespace hyperlattice::equilibrium
