// Sites of a structured lattice, and runs of particles along x.
#pragma once

#include <hyperlattice/component.hpp>

#include <cstdint>

namespace hyperlattice {

struct Site {
  std::int32_t i = 0, j = 0, k = 0;
};

/// The particles begin <= i < end of row (j, k); `first` is the particle at i = begin.
struct Run {
  std::int32_t j = 0, k = 0, begin = 0, end = 0;
  Particle first = 0;
};

/// The sites begin <= i < end of a row.
struct Range {
  std::int32_t begin = 0, end = 0;
};

}  // namespace hyperlattice
