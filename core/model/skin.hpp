// The surface of a body that is not made of cubic cells: that of the small cubes which fill its
// shape, each open face given to the nearest particle. Its area is right where the shape's faces
// are flat and fit the cubes, whatever the particles are like behind it.
#pragma once

#include <model/surfaces.hpp>

#include <functional>

namespace hyperlattice {

class Skin {
 public:
  /// Cubes half a spacing wide inside the shape that the lattice filled; without one, those near to
  /// a particle.
  explicit Skin(const Body& body);

  struct Face {
    Particle particle = 0;       ///< the nearest
    std::uint8_t direction = 0;  ///< as face_normals
    bool inner = false;          ///< open to a cavity, not to the outside
  };
  const std::vector<Face>& faces() const { return faces_; }
  double face_area() const { return width_ * width_; }  ///< m2
  bool has_inner(Particle particle) const { return (sides_[particle] & 1U) != 0; }
  bool has_outer(Particle particle) const { return (sides_[particle] & 2U) != 0; }

 private:
  double width_ = 0;
  std::vector<Face> faces_;
  std::vector<std::uint8_t> sides_;
};

/// As those of surfaces.hpp. The skin is asked for only by regions that mean a surface.
std::vector<Particle> particles_in(const Body& body, const std::function<const Skin&()>& skin,
                                   const Region& region);
std::vector<OpenArea> open_areas(const Body& body, const std::function<const Skin&()>& skin,
                                 const Region& region);

}  // namespace hyperlattice
