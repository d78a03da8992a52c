// The components that the commands use in their own scenes, where the user has named none.
#pragma once

#include <analyze/virtual_test.hpp>
#include <contract/contract.hpp>

namespace hyperlattice::bundled {

/// The default lattice; `analyze` knows crystals for this one only.
inline constexpr const char* cubic = "lattices.cubic";

/// The components around the one under test in `plugins --test`.
inline const contract::OtherComponents other_components{
    .grid = cubic,
    .list = "lattices.random",
    .material = "materials.elastic",
    .failure = "failures.elongation",
    .displacement = "loads.displacement",
    .steps = "solvers.explicit",
};

/// The components of the virtual test in `calibrate --measure`.
inline const VirtualTest::Components virtual_test{.material = "materials.elastic",
                                                  .displacement = "loads.displacement",
                                                  .solver = "solvers.static"};

}  // namespace hyperlattice::bundled
