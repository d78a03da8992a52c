// Surfaces that cut springs: planes, discs, polygons, lists of discs and sheets of triangles. Each
// consists of flat pieces.
//
// A surface may pass exactly through particles. It is therefore moved by a millionth of the spacing
// along its normal, so that each particle has a side: a particle on the surface is on the side that
// the normal points away from. A whole sheet is moved by one vector, so that no gap opens between
// its facets, however they are turned.
#pragma once

#include <base/option_set.hpp>

#include <optional>
#include <string>
#include <vector>

namespace hyperlattice {

/// A flat piece of a surface: a whole plane, or the part of a plane inside an outline. A line that
/// meets the plane on the outline crosses the piece too.
struct FlatPiece {
  /// A facet is a polygon that others of a sheet continue.
  enum class Outline { none, circle, polygon, facet };
  Outline outline = Outline::none;
  Vec3 point;         ///< of the plane, m; the centre of a circle
  Vec3 normal;        ///< of length 1
  double radius = 0;  ///< of a circle, m
  /// of a polygon or facet, m; anticlockwise seen from the tip of the normal
  std::vector<Vec3> corners;
  Vec3 moved_along;  ///< direction in which the piece is moved, see above
  Vec3 low, high;    ///< corners of the box around the piece, m; infinite for a plane

  /// Returns the distance from the plane, m, positive on the side of the normal.
  double height(Vec3 x) const { return dot(x - point, normal); }
  /// Returns whether the moved piece crosses the line from a to b. `spacing`: of the lattice, m.
  bool crosses(Vec3 a, Vec3 b, double spacing) const;

 private:
  bool holds(Vec3 crossing, double tolerance) const;
};

/// A surface that a scene describes.
struct CutSurface {
  std::vector<FlatPiece> pieces;
  /// The region whose particles are separated from all others; there are no pieces then.
  std::optional<RegionId> border_of;
  bool is_list = false;  ///< whether each piece is a surface of its own
};

/// The declaration of a kind of surface.
struct CutKind {
  std::string_view name, summary;
  OptionSet options;
  /// required content of the file that an option names, if an option does
  std::string_view file_holds;
  /// whether the surface has a list of corners, which is no plain option
  bool has_corners = false;
  /// builds the surface; throws std::runtime_error with the reason if the file or the corners are
  /// no such surface
  CutSurface (*make)(const void* options, std::span<const Vec3> corners) = nullptr;
};

/// Returns all kinds.
std::span<const CutKind> cut_kinds();

/// Name and help text of the list of corners.
inline constexpr std::string_view corners_option = "corners";
inline constexpr std::string_view corners_help =
    "the corners one after the other around the polygon, each a vector; at least three, in one "
    "plane. The normal points to where they are seen anticlockwise";

}  // namespace hyperlattice
