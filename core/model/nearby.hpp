// Search for the particle nearest to a point: the particles are sorted into the cells of a coarse
// grid.
#pragma once

#include <model/body.hpp>

namespace hyperlattice {

class Nearby {
 public:
  explicit Nearby(const Body& body);

  struct Found {
    Particle particle = Body::no_particle;
    double distance = infinity;  ///< metres
  };
  Found nearest(Vec3 point) const;

 private:
  struct Cell {
    std::int64_t i = 0, j = 0, k = 0;
  };
  Cell cell_of(Vec3 point) const;
  std::span<const Particle> particles(Cell cell) const;

  const Body& body_;
  double width_ = 0;
  Cell size_;
  /// For each cell the index of its first particle in sorted_; one more entry at the end.
  std::vector<std::uint64_t> first_;
  std::vector<Particle> sorted_;
};

}  // namespace hyperlattice
