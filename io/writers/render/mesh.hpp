// A surface of triangles, each of which has the colour of a particle or of a layer.
#pragma once

#include <hyperlattice/plain.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace hyperlattice::render {

/// What a triangle is part of.
enum class Part : std::uint8_t {
  outside,  ///< the surface of the body
  section,  ///< a face at particles that are not drawn, or in a plane
  crack     ///< a face between particles that do not hold together
};

struct Triangle {
  std::array<std::uint32_t, 3> points{};  ///< indices in Mesh::points
  std::uint32_t particle = 0;
  Part part = Part::outside;
};

struct Mesh {
  std::vector<Vec3> points;  ///< m
  std::vector<Triangle> triangles;
};

/// What remains: the points with dot(normal, point - on) <= 0.
struct ClipPlane {
  Vec3 on, normal;  ///< m; of length 1

  double beyond(Vec3 point) const { return dot(normal, point - on); }
};

}  // namespace hyperlattice::render
