#include "body_surface.hpp"

#include "clip.hpp"
#include "corners.hpp"

namespace hyperlattice::render {

namespace {

struct Face {
  Place cube;
  std::uint8_t direction = 0;  ///< 2 axis + 1 if it looks along the axis
  Part part = Part::outside;
};

bool is_drawn(const DrawnBody& body, std::uint32_t particle) {
  return particle != BodyGrid::none && body.is_drawn[particle];
}

/// How far a cube may reach from where it would be without deformation, edges of cubes.
constexpr double reach = 3;

/// Returns how far a cube is beyond the plane that it is farthest beyond, m.
double beyond_planes(const DrawnBody& body, Place cube, std::uint32_t particle) {
  const Vec3 centre =
      body.position(particle) + (body.grid.centre(cube) - position_of(body.snapshot, particle));
  double most = -infinity;
  for (const ClipPlane& plane : body.planes) most = std::max(most, plane.beyond(centre));
  return most;
}

/// The open faces of a layer of cubes, and the cubes that a plane may cut.
struct Layer {
  std::vector<Face> faces;
  std::vector<Place> cut;
};

Layer layer_of(const DrawnBody& body, std::int32_t k) {
  const BodyGrid& grid = body.grid;
  const double far = reach * grid.edge();
  Layer layer;
  for (Place cube{0, 0, k}; cube.j < grid.count(1); ++cube.j)
    for (cube.i = 0; cube.i < grid.count(0); ++cube.i) {
      const std::uint32_t particle = grid.particle(cube);
      if (!is_drawn(body, particle)) continue;
      if (!body.planes.empty()) {
        const double beyond = beyond_planes(body, cube, particle);
        if (beyond > far) continue;
        if (beyond > -far) layer.cut.push_back(cube);
      }
      for (std::uint8_t direction = 0; direction < 6; ++direction) {
        const std::uint32_t next = grid.particle(neighbour_of(cube, direction));
        if (next == BodyGrid::none)
          layer.faces.push_back({cube, direction, Part::outside});
        else if (!is_drawn(body, next))
          layer.faces.push_back({cube, direction, Part::section});
        else if (body.has_cracks && !body.broken.joins(particle, next))
          layer.faces.push_back({cube, direction, Part::crack});
      }
    }
  return layer;
}

}  // namespace

Mesh surface_of(const DrawnBody& body) {
  std::vector<Layer> layers(static_cast<std::size_t>(body.grid.count(2)));
  body.snapshot.for_each(layers.size(), [&](std::uint64_t k) {
    layers[k] = layer_of(body, static_cast<std::int32_t>(k));
  });
  Corners corners(body);
  Mesh mesh;
  std::vector<CutCube> cut;
  for (const Layer& layer : layers) {
    for (const Face& face : layer.faces) {
      std::uint32_t at[4];
      for (int n = 0; n < 4; ++n) at[n] = corners.index(face.cube, face_corners[face.direction][n]);
      const std::uint32_t particle = body.grid.particle(face.cube);
      mesh.triangles.push_back({{at[0], at[1], at[2]}, particle, face.part});
      mesh.triangles.push_back({{at[0], at[2], at[3]}, particle, face.part});
    }
    for (const Place cube : layer.cut) {
      CutCube& of = cut.emplace_back();
      of.particle = body.grid.particle(cube);
      for (int n = 0; n < 8; ++n) of.corners[static_cast<std::size_t>(n)] = corners.index(cube, n);
    }
  }
  mesh.points = corners.places();
  clip(mesh, body.planes, cut);
  return mesh;
}

}  // namespace hyperlattice::render
