// The size of a body beside that of its shape. They differ if the edges of the shape are not
// multiples of the spacing, because the body consists of whole cells.
#pragma once

#include <model/model.hpp>

#include <optional>

namespace hyperlattice {

/// The sets of particles that springs connect.
struct Parts {
  std::uint64_t count = 0;   ///< number of sets; a particle without springs is one
  std::uint64_t loose = 0;   ///< number of particles without springs
  Particle first_loose = 0;  ///< the first of them
};

Parts parts_of(const Body& body);

struct BodyFigures {
  /// Edges of the box around the body's cells, or around the particles of a list, m.
  Vec3 size;
  /// Whether the body is a list: its size is then the box around the outermost particles.
  bool of_particles = false;
  /// Whether the body consists of partial cells, whose corners stand outside the shape: its size is
  /// that of the shape.
  bool is_partial = false;
  bool is_centred = false;  ///< whether a particle stands for less than a cube of the lattice
  std::optional<Vec3> asked_size;              ///< edges of the box around the shape, m
  bool asked_at_most = false;                  ///< whether that box may be larger than the shape
  std::uint64_t cells = 0, partial_cells = 0;  ///< numbers of all cells, and of those not whole
  double volume = 0, mass = 0;                 ///< m3, kg
  /// Volume, m3, and mass, kg, of the shape if its volume is known; the mass only for one material.
  std::optional<double> asked_volume, asked_mass;
  std::uint64_t cut_springs = 0;  ///< number of springs that the lattice's cuts took away
  Parts parts;
};

BodyFigures body_figures(const Model& model);

/// Returns names and values as texts: size, volume, mass, number of bodies. The value of the shape
/// follows if its text is different.
std::vector<std::pair<std::string, std::string>> body_lines(const BodyFigures& figures);

/// Returns a warning for each axis along which the body is more than 1 % wider or narrower than its
/// shape; if there is none, for a volume that differs by more than 2 %, which can happen in
/// lattices with particles between the planes of sites and in bodies of partial cells. A listed
/// body gives no warning: its particles are inside the shape.
std::vector<std::string> size_warnings(const BodyFigures& figures, double spacing);

/// Returns a warning about particles without springs; empty if there are none.
std::string loose_warning(const Body& body, const Parts& parts);

}  // namespace hyperlattice
