// The surface of a body: the open faces of its cells, the particles of a region, and the area that
// each particle stands for. A particle stands for the faces of its own cell; in a body of cells,
// for a quarter of each face that it is a corner of.
#pragma once

#include <model/body.hpp>

#include <hyperlattice/load.hpp>

#include <array>
#include <vector>

namespace hyperlattice {

/// Set of the faces of a cell that no other cell covers: bit 0 -x, 1 +x, 2 -y, 3 +y, 4 -z, 5 +z, as
/// face_normals.
using OpenFaces = std::uint32_t;

/// Finds the open faces of cells. A cavity is an empty space without a path through faces to the
/// outside.
class Surfaces {
 public:
  explicit Surfaces(const Body& body);
  OpenFaces faces(Site cell) const;        ///< all open faces of an existing cell
  OpenFaces outer_faces(Site cell) const;  ///< faces open to the outside
  OpenFaces inner_faces(Site cell) const;  ///< faces open to cavities

 private:
  void flood() const;
  bool is_outside(Site cell) const;

  const Body& body_;
  std::array<std::int64_t, 3> widened_;
  /// For each cell of the box widened by one cell: whether it is outside the body. Computed on
  /// first use.
  mutable std::vector<bool> outside_;
};

/// Returns the particles of a region, ascending. A solid holds the particles inside it; in a body
/// of cells also those on its surface, up to round-off.
std::vector<Particle> particles_in(const Body& body, const Surfaces& surfaces,
                                   const Region& region);

/// Returns the cells of a region in a body of cells, as indices in its runs, ascending. A solid
/// holds a cell if the centre of the cell is inside.
std::vector<Particle> cells_in(const Body& body, const Surfaces& surfaces, const Region& region);

/// Returns the open area of a region (see LoadBody) for each particle, ascending. A face counts if
/// the region holds all particles of the face, and if the face is open to the side of the region:
/// to the cavity for inner_surface, to the outside for outer_surface, in that one direction for
/// x_min ... z_max, to any side for others. A union has the faces of any part, an intersection the
/// faces that all parts have, a difference the faces of the first part whose particles are not all
/// in one other part.
std::vector<OpenArea> open_areas(const Body& body, const Surfaces& surfaces, const Region& region);

}  // namespace hyperlattice
