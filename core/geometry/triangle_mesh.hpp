// A closed surface of triangles as a solid: is it one, and which points does it hold.
#pragma once

#include <hyperlattice/plain.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace hyperlattice {

struct TriangleMesh {
  std::vector<Vec3> points;  ///< metres, each once
  std::vector<std::array<std::uint32_t, 3>>
      facets;                          ///< three points, anticlockwise seen from outside
  std::vector<std::uint32_t> numbers;  ///< of each facet in the file, from 1
  std::vector<std::size_t> sections;   ///< first facet of each "solid" of the file
};

/// Reads STL, ASCII or binary; a length of 1 in the file is `scale` metres. Facets that touch share
/// points whose coordinates are the same to the last bit; facets with the same point twice are
/// dropped. A text may hold several solids, or one in several patches. Throws std::runtime_error
/// with a sentence that says what is wrong where.
TriangleMesh read_stl(std::string_view bytes, double scale);

/// Why the surface does not bound a solid: an edge without exactly one neighbour in the opposite
/// direction, or facets that point inwards. Empty: it does.
std::string solid_fault(const TriangleMesh& mesh);

/// Whether the file has several sections, each of which bounds a solid by itself: together they are
/// solids that touch.
bool sections_are_solids(const TriangleMesh& mesh);

/// Areas of closed parts of the surface that face outwards and of those that bound cavities, in m2.
struct SurfaceAreas {
  double outer = 0, inner = 0;
};
SurfaceAreas surface_areas(const TriangleMesh& mesh);

/// Whether a point is inside: how often the surface winds around it, counted along a ray. Two
/// facets that share an edge find the same crossing of it to the last bit, so the ray slips through
/// no edge and no corner; only points within rounding of the surface may count as either.
class InsideTest {
 public:
  explicit InsideTest(TriangleMesh mesh);
  bool operator()(Vec3 point) const { return winding(point) != 0; }
  int winding(Vec3 point) const;  ///< 1 inside of a part that faces outwards, 2 inside of two
  const TriangleMesh& mesh() const { return mesh_; }
  Vec3 low() const { return low_; }  ///< of the bounding box
  Vec3 high() const { return high_; }

 private:
  using Facet = std::array<std::uint32_t, 3>;
  std::size_t column_of(double y) const;
  std::size_t row_of(double z) const;

  TriangleMesh mesh_;
  Vec3 low_, high_;
  std::size_t side_ = 1;                          ///< bins along y and along z
  std::vector<std::vector<std::uint32_t>> bins_;  ///< facets whose shadow along x touches the bin
};

/// Which closed part of a surface faces the wrong way: it lies within another part and faces
/// outwards, so that a cavity would be filled, or within no other and faces inwards. Empty: none.
std::string orientation_fault(const InsideTest& inside);

}  // namespace hyperlattice
