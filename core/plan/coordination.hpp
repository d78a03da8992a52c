// How many springs hold each particle of a list: a particle on fewer than three swings.
#pragma once

#include <model/body.hpp>

namespace hyperlattice {

struct Coordination {
  std::uint64_t fewest = 0, most = 0;
  std::uint64_t swinging = 0;  ///< particles with fewer than three springs
};

Coordination coordination_of(const Body& body);  ///< of a listed body

}  // namespace hyperlattice
