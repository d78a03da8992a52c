// A solid bounded by a closed surface of triangles: reading, checks, and the test whether a point
// is inside.
#pragma once

#include <geometry/solid_surface.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace hyperlattice {

/// A surface of triangles with shared points.
struct TriangleMesh {
  std::vector<Vec3> points;  ///< positions, m, without duplicates
  /// indices of three points, anticlockwise seen from outside
  std::vector<std::array<std::uint32_t, 3>> facets;
  std::vector<std::uint32_t> numbers;  ///< number of each facet in the file, from 1
  std::vector<std::size_t> sections;   ///< index of the first facet of each "solid" in the file
};

/// Reads STL, ASCII or binary; a length of 1 in the file is `scale` metres. Corners with bitwise
/// equal coordinates become one point. Facets that have the same point twice are dropped. A text
/// may hold several solids, or one solid in several patches. Throws std::runtime_error with a
/// sentence that says what is wrong and where.
TriangleMesh read_stl(std::string_view bytes, double scale);

/// Returns why the surface does not bound a solid: an edge without exactly one neighbour in the
/// opposite direction, or facets that point inwards. Empty if it bounds one.
std::string solid_fault(const TriangleMesh& mesh);

/// Returns whether the file has several sections and each of them bounds a solid by itself; the
/// sections are then solids that touch.
bool sections_are_solids(const TriangleMesh& mesh);

/// Areas of the closed parts of a surface, m2: `outer` of parts that face outwards, `inner` of
/// parts that bound cavities.
struct SurfaceAreas {
  double outer = 0, inner = 0;
};
SurfaceAreas surface_areas(const TriangleMesh& mesh);

/// Tests whether a point is inside, by the winding number along a ray. Two facets with a common
/// edge compute its crossing identically to the last bit, so no ray passes between them at an edge
/// or a corner. Only points within rounding of the surface may get either answer.
class InsideTest final : public FacetedSolid {
 public:
  explicit InsideTest(TriangleMesh mesh);
  bool operator()(Vec3 point) const { return winding(point) != 0; }
  /// winding number: 1 inside one part that faces outwards, 2 inside two
  int winding(Vec3 point) const;
  const TriangleMesh& mesh() const { return mesh_; }
  Vec3 low() const { return low_; }  ///< corner of the bounding box, m
  Vec3 high() const { return high_; }

  // The next three are in mesh_in_cube.cpp. Parts that overlap count twice in volume_in().
  Side side_of(const Cube& cube) const override;
  double volume_in(const Cube& cube) const override;
  std::vector<Plane> planes_in(const Cube& cube, std::size_t most) const override;

 private:
  using Facet = std::array<std::uint32_t, 3>;
  /// A range of bins.
  struct Bins {
    std::size_t first_row, last_row, first_column, last_column;
  };
  std::size_t column_of(double y) const;
  std::size_t row_of(double z) const;
  /// Returns the bins that the facet's projection touches.
  Bins bins_of(const Facet& facet) const;
  /// Calls visit(a, b, c) for the corners of each facet, each once, that is beside the cube in
  /// y and z, or touches it there.
  template <class Visit>
  void for_facets_beside(const Cube& cube, const Visit& visit) const;

  TriangleMesh mesh_;
  Vec3 low_, high_;
  std::size_t side_ = 1;  ///< number of bins along y, and along z
  /// facets whose projection along x touches the bin
  std::vector<std::vector<std::uint32_t>> bins_;
};

/// Returns which closed part of the surface faces the wrong way: a part within another that faces
/// outwards, so that a cavity would be filled, or a part within no other that faces inwards. Empty
/// if there is none.
std::string orientation_fault(const InsideTest& inside);

}  // namespace hyperlattice
