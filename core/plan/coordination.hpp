// How many springs hold each particle of a list: a particle on fewer than three swings, and a body
// with too few on the mean gives way.
#pragma once

#include <model/body.hpp>

namespace hyperlattice {

struct Coordination {
  std::uint64_t fewest = 0, most = 0;
  std::uint64_t swinging = 0;  ///< particles with fewer than three springs
};

Coordination coordination_of(const Body& body);  ///< of a listed body

/// What there is to say of a listed body with too few springs to be stiff: fewer than its
/// particles' coordinates (Maxwell 1864), or hardly more. Cross springs in the fourth dimension
/// stand beside those and add nothing. "": they are enough.
std::string coordination_warning(const Body& body);

}  // namespace hyperlattice
