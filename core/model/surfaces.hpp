// The surface of a body: the open faces of its cells, the particles of a region, and the area that
// each particle stands for. A particle stands for the faces of its own cell; in a body of cells,
// for a quarter of each face that it is a corner of. Between two cells with the shares a > b, the
// part a - b of the face is open: the surface of partial cells is spread over two or three layers
// of faces, whose areas are those of the true surface.
#pragma once

#include <model/body.hpp>

#include <hyperlattice/load.hpp>

#include <array>
#include <functional>
#include <optional>
#include <vector>

namespace hyperlattice {

/// Set of the faces of a cell that no other cell covers fully: bit 0 -x, 1 +x, 2 -y, 3 +y, 4 -z, 5
/// +z, as face_normals.
using OpenFaces = std::uint32_t;

/// Finds the open faces of cells. A cavity is an empty space without a path through faces to the
/// outside. The space beside the solid in a partial cell belongs to the nearest empty cell; where
/// no empty cell can be reached through partial cells, it is a cavity.
class Surfaces {
 public:
  explicit Surfaces(const Body& body);
  OpenFaces faces(Site cell) const;        ///< all open faces of an existing cell
  OpenFaces outer_faces(Site cell) const;  ///< faces open to the outside
  OpenFaces inner_faces(Site cell) const;  ///< faces open to cavities
  /// Returns the part of the cell's face that is open, 0 to 1. `direction`: as in face_normals.
  double open_part(Site cell, int direction) const;
  /// Returns whether the body ends within the layer of cells that is outermost in a direction, and
  /// the site is at the inner end of this layer: then it is at the end of the body too. The body
  /// ends within the layer if no cell of the layer is whole.
  bool is_at_cut_end(Site site, int direction) const;

 private:
  void flood() const;
  bool is_outside(Site cell) const;
  double share(Site cell) const;
  bool ends_within_cells(int direction) const;

  const Body& body_;
  std::array<std::int64_t, 3> widened_;
  /// For each cell of the box widened by one cell: whether it, or the space in it, is outside the
  /// body. Computed on first use.
  mutable std::vector<bool> outside_;
  /// For each direction: whether the body ends within cells. Computed on first use.
  mutable std::array<std::optional<bool>, 6> ends_within_;
};

/// Returns the particles of a region, ascending. A solid holds the particles inside it; in a body
/// of cells also those on its surface, up to round-off. x_min and its like hold the outermost
/// particles; where the surface cuts the cells there, all corners of these cells.
std::vector<Particle> particles_in(const Body& body, const Surfaces& surfaces,
                                   const Region& region);
/// Calls visit(particle) for the same particles.
void for_particles_in(const Body& body, const Surfaces& surfaces, const Region& region,
                      const std::function<void(Particle)>& visit);

/// Returns the cells of a region in a body of cells, as indices in its runs, ascending. A solid
/// holds a cell if the centre of the cell is inside; a partial cell, if at least half of the cell's
/// part of the body is.
std::vector<Particle> cells_in(const Body& body, const Surfaces& surfaces, const Region& region);

/// Returns the open area of a region (see LoadBody) for each particle, ascending. A face counts if
/// the region holds all particles of the face, and if the face is open to the side of the region:
/// to the cavity for inner_surface, to the outside for outer_surface, in that one direction for
/// x_min ... z_max, to any side for others. A union has the faces of any part, an intersection the
/// faces that all parts have, a difference the faces of the first part whose particles are not all
/// in one other part.
std::vector<OpenArea> open_areas(const Body& body, const Surfaces& surfaces, const Region& region);

}  // namespace hyperlattice
