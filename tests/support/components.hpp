// The components that the tools' scenes are made of in tests.
#pragma once

#include <analyze/virtual_test.hpp>
#include <contract/contract.hpp>

namespace hyperlattice::test {

/// Around a component under test.
inline const contract::OtherComponents around{.grid = "lattices.cubic",
                                              .list = "lattices.random",
                                              .material = "materials.elastic",
                                              .failure = "failures.elongation",
                                              .displacement = "loads.displacement",
                                              .steps = "solvers.explicit"};

/// A virtual test of that lattice.
inline VirtualTest virtual_test(Host& host, VirtualTest::Options options) {
  return {host,
          {.material = "materials.elastic",
           .displacement = "loads.displacement",
           .solver = "solvers.static"},
          std::move(options)};
}

}  // namespace hyperlattice::test
