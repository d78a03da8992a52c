// Solids, surfaces and sets of them, as a scene names them. A region is an immutable tree; what it
// means for particles is model/'s work.
#pragma once

#include <hyperlattice/plain.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hyperlattice {

struct Region {
  enum class Kind {
    all,            ///< every particle
    solid,          ///< inside `contains`
    surface,        ///< particles with an uncovered face
    inner_surface,  ///< with a face to a cavity that is closed off from outside
    outer_surface,  ///< with a face to the outside
    face,           ///< the outermost layer towards face_normals[direction]: x_min ... z_max
    set_union,
    intersection,
    difference  ///< of `parts`; difference: the first without the others
  };
  Kind kind = Kind::all;
  int direction = 0;
  std::vector<std::shared_ptr<const Region>> parts;

  // of a solid: what a primitive knows
  std::string primitive;             ///< "box", "sphere", "hollow_sphere", "cylinder", "half_space"
  std::function<bool(Vec3)> inside;  ///< on the boundary counts as inside
  Vec3 low, high;                    ///< bounding box; infinite for a half-space
  Vec3 anchor, centre;               ///< see Shape::anchor
  double volume = 0;                 ///< m3, 0 if unknown
  double outer_area = 0,
         inner_area =
             0;  ///< true areas in m2 of the outer surface and of the cavity's, 0 if unknown

  /// Whether the region is a solid (or a set of solids), so that `contains` has a meaning without a
  /// lattice.
  bool is_solid() const;
  bool contains(Vec3 point) const;  ///< of a solid or a set of solids
};

/// Regions that need no description: "all", "surface", "inner_surface", "outer_surface", "x_min"
/// ... "z_max". Null: no such name.
std::shared_ptr<const Region> built_in_region(std::string_view name);
const std::vector<std::string>& built_in_region_names();

/// A set of regions: union, intersection, or the first without the others. Box, anchor and centre
/// follow from the parts when all are solids; parts without a common point give an inverted box
/// (low > high).
std::shared_ptr<const Region> make_set(Region::Kind kind,
                                       std::vector<std::shared_ptr<const Region>> parts);

/// The box around a solid.
struct SolidExtent {
  Vec3 low, high;  ///< infinite for a half-space
  bool attained =
      false;  ///< the solid is known to reach all its sides; false: it lies inside, perhaps farther
};
/// Of a solid or a set of solids. What is cut off over a whole side makes it smaller; a cut solid
/// is known to reach a side if one of many points within 1/4 % of the width is inside.
SolidExtent extent_of(const Region& solid);

/// The regions of a scene, by index (RegionId); index 0 is "all". Entries stay where they are.
class Regions {
 public:
  Regions();
  RegionId add(std::shared_ptr<const Region> region, std::string name);
  const Region& operator[](RegionId id) const { return *regions_[id.index].region; }
  const std::string& name(RegionId id) const {
    return regions_[id.index].name;
  }  ///< as in the scene; for messages
  std::optional<RegionId> find(const std::string& name) const;
  std::vector<std::string> names() const;
  std::size_t size() const { return regions_.size(); }

  /// A Shape for a solid region, for a lattice plugin; valid as long as this object.
  const Shape* shape(std::shared_ptr<const Region> region);

 private:
  struct Entry {
    std::shared_ptr<const Region> region;
    std::string name;
  };
  std::vector<Entry> regions_;
  std::vector<std::unique_ptr<std::pair<std::shared_ptr<const Region>, Shape>>> shapes_;
};

}  // namespace hyperlattice
