// Components that the scenes of `analyze` and `contract` are made of in tests.
#pragma once

#include <analyze/virtual_test.hpp>
#include <contract/contract.hpp>

namespace hyperlattice::test {

/// The components that surround a component under test.
inline const contract::OtherComponents around{.grid = "lattices.cubic",
                                              .list = "lattices.random",
                                              .material = "materials.elastic",
                                              .failure = "failures.elongation",
                                              .displacement = "loads.displacement",
                                              .steps = "solvers.explicit"};

/// A virtual test with the elastic material and the static solver.
inline VirtualTest virtual_test(Host& host, VirtualTest::Options options) {
  return {host,
          {.material = "materials.elastic",
           .displacement = "loads.displacement",
           .solver = "solvers.static"},
          std::move(options)};
}

}  // namespace hyperlattice::test
