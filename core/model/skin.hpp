// The surface of a body that does not consist of cubic cells: the surface of small cubes that fill
// its shape. Each open face belongs to the nearest particle. The area is exact where the faces of
// the shape are flat and fit the cubes, for any arrangement of the particles.
#pragma once

#include <model/surfaces.hpp>

#include <functional>

namespace hyperlattice {

class Skin {
 public:
  /// Fills the body's shape with cubes half a spacing wide; without a shape, the neighbourhood of
  /// the particles.
  explicit Skin(const Body& body);

  struct Face {
    Particle particle = 0;       ///< the nearest particle
    std::uint8_t direction = 0;  ///< index in face_normals
    bool inner = false;          ///< whether the face is open to a cavity, not to the outside
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

/// Return the same as the functions in surfaces.hpp. They ask for the skin only if a region needs a
/// surface.
std::vector<Particle> particles_in(const Body& body, const std::function<const Skin&()>& skin,
                                   const Region& region);
std::vector<OpenArea> open_areas(const Body& body, const std::function<const Skin&()>& skin,
                                 const Region& region);

}  // namespace hyperlattice
