// The body at rest as equal cubes of a grid, each of which belongs to a particle. Together they
// have the size of the body that a picture shows.
#pragma once

#include <model/body.hpp>

#include <hyperlattice/output.hpp>

namespace hyperlattice {

/// The arrays of BodyCubes.
struct CubeGrid {
  Vec3 origin;  ///< low corner of the cube (0, 0, 0), m
  double edge = 0;
  std::int32_t count[3] = {};
  std::vector<std::uint32_t> particle;

  BodyCubes view() const;
};

/// Returns the cubes of a body. Cubic lattice: the cell of each particle; with boundary cells, the
/// eighths of each cell, which belong to its corners; a partial cell counts if at least half of it
/// is inside the shape. Other lattices: cubes half a spacing wide that fill the shape (skin.hpp);
/// each belongs to the nearest particle. Throws std::length_error if the body has too many
/// particles or cubes for a picture, 2^32 - 1.
CubeGrid cubes_of(const Body& body);

}  // namespace hyperlattice
