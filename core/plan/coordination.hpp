// The number of springs at each particle of a list. A particle with fewer than three springs
// swings; a body with too few on average is not stiff.
#pragma once

#include <model/body.hpp>

namespace hyperlattice {

struct Coordination {
  std::uint64_t fewest = 0, most = 0;
  std::uint64_t swinging = 0;  ///< particles with fewer than three springs
};

/// Returns the coordination of a listed body.
Coordination coordination_of(const Body& body);

/// Returns a warning if a listed body has too few springs to be stiff: fewer than the coordinates
/// of its particles (Maxwell 1864), or hardly more. Cross springs in the fourth dimension accompany
/// base springs and do not count. Returns "" if the springs suffice.
std::string coordination_warning(const Body& body);

}  // namespace hyperlattice
