// The surface of a body: which faces of which cells are open, which particles a region means, and
// how much surface each of them stands for. A particle stands for its own cell; in a body of cells,
// for a quarter of each face that it is a corner of.
#pragma once

#include <model/body.hpp>

#include <hyperlattice/load.hpp>

#include <array>
#include <vector>

namespace hyperlattice {

/// Faces of a cell that no other cell covers: bit 0 -x, 1 +x, 2 -y, 3 +y, 4 -z, 5 +z, as
/// face_normals.
using OpenFaces = std::uint32_t;

/// The open faces of cells. A cavity is an empty space that no path through faces joins to the
/// outside.
class Surfaces {
 public:
  explicit Surfaces(const Body& body);
  OpenFaces faces(Site cell) const;        ///< all; of a cell that is there
  OpenFaces outer_faces(Site cell) const;  ///< to the outside
  OpenFaces inner_faces(Site cell) const;  ///< to cavities

 private:
  void flood() const;
  bool is_outside(Site cell) const;

  const Body& body_;
  std::array<std::int64_t, 3> widened_;
  mutable std::vector<bool>
      outside_;  ///< of each cell of the box widened by one; flooded when first asked for
};

/// Particles of a region, ascending. A solid holds a particle inside it; one that is a corner of
/// cells, also if it only touches it, up to rounding.
std::vector<Particle> particles_in(const Body& body, const Surfaces& surfaces,
                                   const Region& region);

/// Cells of a region in a body of cells, by their place in its runs, ascending. A solid holds a
/// cell whose centre is inside.
std::vector<Particle> cells_in(const Body& body, const Surfaces& surfaces, const Region& region);

/// The surface that a region means (see LoadBody), by particles, ascending. Faces count if they are
/// open to the side that the region means: to the cavity for inner_surface, to the outside for
/// outer_surface, that one direction for x_min ... z_max, any for others; and if the region holds
/// all particles that the face belongs to. Of a union faces of any part, of an intersection those
/// of all, of a difference those of the first part that no other part holds.
std::vector<OpenArea> open_areas(const Body& body, const Surfaces& surfaces, const Region& region);

}  // namespace hyperlattice
