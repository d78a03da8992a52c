// The surfaces of solids, as the volume of a solid inside a cube needs them.
#pragma once

#include <hyperlattice/plain.hpp>

#include <vector>

namespace hyperlattice {

/// A cube with edges along the axes, m.
struct Cube {
  Vec3 low;  ///< corner with the smallest coordinates
  double edge = 0;

  Vec3 high() const { return low + edge * Vec3{1, 1, 1}; }
  Vec3 centre() const { return low + 0.5 * edge * Vec3{1, 1, 1}; }
  double volume() const { return edge * edge * edge; }
  /// Returns one of the eight cubes of half the edge, n = 0 .. 7.
  Cube eighth(unsigned n) const {
    const double half = 0.5 * edge;
    return {low + half * Vec3{(n & 1U) != 0 ? 1.0 : 0.0, (n & 2U) != 0 ? 1.0 : 0.0,
                              (n & 4U) != 0 ? 1.0 : 0.0},
            half};
  }
};

/// Where a cube lies: inside a solid, outside, or neither for certain.
enum class Side { inside, outside, cut };

/// An oriented plane: `normal`, of length 1, points to the outside.
struct Plane {
  Vec3 point;  ///< m
  Vec3 normal;

  /// Returns the distance from the plane, m, positive outside.
  double height(Vec3 x) const { return dot(x - point, normal); }
};

/// A surface of a solid: a plane, a sphere, or the round side of an endless cylinder.
struct SolidSurface {
  Vec3 point;      ///< of the plane, of the cylinder's axis, or the centre of the sphere, m
  Vec3 direction;  ///< unit normal of a plane, to the outside; unit axis of a cylinder; 0: sphere
  double radius = 0;       ///< m; 0: a plane
  bool is_cavity = false;  ///< whether the solid lies outside of a sphere or cylinder

  bool is_plane() const { return radius == 0; }
  /// Returns the distance from the surface, m, positive outside the solid.
  double height(Vec3 x) const;
  Side side_of(const Cube& cube) const;
  /// Returns the plane that touches the surface at the point nearest to x.
  Plane tangent(Vec3 x) const;
  /// Returns the distance, m, of the surface from a point on a tangent plane, along its normal:
  /// positive if the solid is smaller than the half-space.
  double sag(Vec3 on_tangent) const;

 private:
  Vec3 radial(Vec3 x) const { return (x - point) - dot(x - point, direction) * direction; }
};

/// A solid with very many faces, a mesh or an image, which computes its volume in a cube itself.
class FacetedSolid {
 public:
  virtual ~FacetedSolid() = default;
  virtual Side side_of(const Cube& cube) const = 0;
  /// Returns the volume inside the cube, m3; exact up to round-off.
  virtual double volume_in(const Cube& cube) const = 0;
  /// Returns planes that hold all faces inside the cube. It stops after more than `most` planes.
  virtual std::vector<Plane> planes_in(const Cube& cube, std::size_t most) const = 0;
};

}  // namespace hyperlattice
