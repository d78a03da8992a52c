// How large a body came out, beside what its shape asks for: whole cells fill a shape only if its
// edges are multiples of the spacing.
#pragma once

#include <model/model.hpp>

#include <optional>

namespace hyperlattice {

struct BodyFigures {
  Vec3 size;  ///< m, edges of the box around the body's cells, or around the particles of a list
  bool of_particles =
      false;  ///< the body is a list: its size is that between its outermost particles
  bool is_centred = false;         ///< a particle stands for less than a cube of the lattice
  std::optional<Vec3> asked_size;  ///< of the box around the shape
  bool asked_at_most = false;      ///< that box may be larger than the shape
  double volume = 0, mass = 0;     ///< m3, kg
  std::optional<double> asked_volume,
      asked_mass;           ///< of a shape whose volume is known; mass: of one material
  std::uint64_t parts = 0;  ///< bodies that no spring joins to each other
};

BodyFigures body_figures(const Model& model);

/// Names and values for people: size, volume, mass, bodies; those that the shape asks for beside
/// them unless they look alike.
std::vector<std::pair<std::string, std::string>> body_lines(const BodyFigures& figures);

/// Warns of each axis along which the body is more than 1 % wider or narrower than its shape; if
/// there is none, of a volume that differs by more than 2 %, which a lattice of particles between
/// its planes may have. What a list is lies inside its shape.
std::vector<std::string> size_warnings(const BodyFigures& figures, double spacing);

/// The number of sets of particles that springs join.
std::uint64_t count_parts(const Body& body);

}  // namespace hyperlattice
