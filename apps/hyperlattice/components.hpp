// The components that the commands bring along: what their scenes are made of where a user has
// named nothing.
#pragma once

#include <analyze/virtual_test.hpp>
#include <contract/contract.hpp>

namespace hyperlattice::bundled {

/// The lattice that is meant if none is named, and the one whose crystals are known.
inline constexpr const char* cubic = "lattices.cubic";

/// Of `plugins --test`.
inline const contract::Surroundings surroundings{
    .grid = cubic,
    .list = "lattices.random",
    .material = "materials.elastic",
    .failure = "failures.elongation",
    .displacement = "loads.displacement",
    .steps = "solvers.explicit",
};

/// Of `calibrate --measure`.
inline const VirtualTest::Components virtual_test{.material = "materials.elastic",
                                                  .displacement = "loads.displacement",
                                                  .solver = "solvers.static"};

}  // namespace hyperlattice::bundled
