// Which points and faces of a body a region has, for any kind of body. `Places` describes one kind
// of body:
//   Point, Face: a particle (or cell); an open face of the surface
//   bool in_solid(region, point): whether the point is in the solid
//   bool has_face(region, point): whether the point has a face for which is_open() holds
//   bool is_outermost(point, direction): whether the point is outermost in the direction
//   bool is_open(region, face): whether the face is open to the side of the region
//   void for_points(face, visit): calls visit(point) for each point of the face
#pragma once

#include <geometry/region.hpp>

#include <algorithm>

namespace hyperlattice {

template <class Places>
class RegionMembership {
 public:
  using Point = typename Places::Point;
  using Face = typename Places::Face;

  explicit RegionMembership(const Places& places) : places_(places) {}

  bool holds(const Region& region, const Point& point) const {
    const auto part_holds = [&](const auto& part) { return holds(*part, point); };
    switch (region.kind) {
      case Region::Kind::all:
        return true;
      case Region::Kind::solid:
        return places_.in_solid(region, point);
      case Region::Kind::surface:
      case Region::Kind::inner_surface:
      case Region::Kind::outer_surface:
        return places_.has_face(region, point);
      case Region::Kind::face:
        return places_.is_outermost(point, region.direction);
      case Region::Kind::set_union:
        return std::any_of(region.parts.begin(), region.parts.end(), part_holds);
      case Region::Kind::intersection:
        return std::all_of(region.parts.begin(), region.parts.end(), part_holds);
      case Region::Kind::difference:
        return part_holds(region.parts.front()) &&
               std::none_of(region.parts.begin() + 1, region.parts.end(), part_holds);
    }
    return false;
  }

  /// Returns whether the open face is part of the region. A region without parts has the face if it
  /// holds all points of it and the face is open to the side of the region.
  bool holds_face(const Region& region, const Face& face) const {
    const auto part_holds_face = [&](const auto& part) { return holds_face(*part, face); };
    const auto part_holds = [&](const auto& part) { return holds_all(*part, face); };
    switch (region.kind) {
      case Region::Kind::set_union:
        return std::any_of(region.parts.begin(), region.parts.end(), part_holds_face);
      case Region::Kind::intersection:
        return std::all_of(region.parts.begin(), region.parts.end(), part_holds_face);
      case Region::Kind::difference:
        return part_holds_face(region.parts.front()) &&
               std::none_of(region.parts.begin() + 1, region.parts.end(), part_holds);
      default:
        return places_.is_open(region, face) && holds_all(region, face);
    }
  }

 private:
  bool holds_all(const Region& region, const Face& face) const {
    bool all = true;
    places_.for_points(face, [&](const Point& point) { all = all && holds(region, point); });
    return all;
  }

  const Places& places_;
};

}  // namespace hyperlattice
