// The infinite cubic lattice, written independently of its plugin.
#pragma once

#include <model/waves.hpp>

#include <hyperlattice/calibration.hpp>

namespace hyperlattice::test {

/// The cubic lattice with k = 1, l = Delta = 1.
class Cubic {
 public:
  explicit Cubic(const calibration::Ratios& r) : springs_{{1, r.beta}, {1, r.gamma}} {
    constexpr int forward[9][3] = {{1, 0, 0},  {-1, 1, 0}, {0, 1, 0}, {1, 1, 0}, {0, -1, 1},
                                   {-1, 0, 1}, {0, 0, 1},  {1, 0, 1}, {0, 1, 1}};
    for (const auto& [x, y, z] : forward) {
      const double square = x * x + y * y + z * z;
      neighbours_.push_back({{x, y, z, square > 1 ? 1u : 0u},
                             {double(x), double(y), double(z)},
                             std::sqrt(square),
                             std::sqrt(square + 1)});
    }
    lattice.neighbours = neighbours_;
    lattice.springs = springs_;
    lattice.alpha = r.clamped ? 0 : r.alpha;
    lattice.membrane_distance = lattice.spacing = 1;
    lattice.membrane = r.clamped ? KernelChoice::Membrane::clamped : KernelChoice::Membrane::free;
  }
  Cubic(const Cubic&) = delete;
  Cubic& operator=(const Cubic&) = delete;

  InfiniteLattice lattice;

 private:
  std::vector<NeighbourGeometry> neighbours_;
  std::vector<SpringConstants> springs_;
};

}  // namespace hyperlattice::test
