// Regions of a scene: solids, surfaces and sets of regions. A region is an immutable tree;
// core/model/ finds its particles.
#pragma once

#include <geometry/solid_surface.hpp>

#include <hyperlattice/plain.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hyperlattice {

/// A node of the tree. Lengths in m.
struct Region {
  enum class Kind {
    all,            ///< every particle
    solid,          ///< points for which `inside` is true
    surface,        ///< particles with a free face
    inner_surface,  ///< particles with a face to a closed cavity
    outer_surface,  ///< particles with a face to the outside
    face,           ///< the outermost layer towards face_normals[direction]: x_min ... z_max
    set_union,
    intersection,
    difference  ///< the first of `parts` without the others
  };
  Kind kind = Kind::all;
  int direction = 0;
  std::vector<std::shared_ptr<const Region>> parts;

  // The following members describe a solid.
  std::string primitive;             ///< name of the primitive, such as "box"
  std::function<bool(Vec3)> inside;  ///< true also on the boundary
  Vec3 low, high;                    ///< bounding box; infinite for a half-space
  Vec3 anchor, centre;               ///< see Shape::anchor
  double volume = 0;                 ///< m3; 0 if unknown
  /// The surfaces whose inner sides have the solid in common; empty for solids with `facets`.
  std::vector<SolidSurface> surfaces;
  std::shared_ptr<const FacetedSolid> facets;  ///< null for solids with `surfaces`
  /// exact areas of the outer surface and of the cavity's surface, m2; 0 if unknown
  double outer_area = 0, inner_area = 0;

  /// Returns whether the region is a solid or a set of solids, for which contains() needs no
  /// lattice.
  bool is_solid() const;
  bool contains(Vec3 point) const;  ///< for a solid or a set of solids; otherwise false
};

/// Returns a predefined region: "all", "surface", "inner_surface", "outer_surface", "x_min" ...
/// "z_max". Null for other names.
std::shared_ptr<const Region> built_in_region(std::string_view name);
/// Returns the names of all predefined regions.
const std::vector<std::string>& built_in_region_names();

/// Returns a set of regions: union, intersection, or the first without the others. If all parts are
/// solids, box, anchor and centre follow from them. An intersection of separate boxes has an
/// inverted box (low > high).
std::shared_ptr<const Region> make_set(Region::Kind kind,
                                       std::vector<std::shared_ptr<const Region>> parts);

/// The bounding box of a solid, m.
struct SolidExtent {
  Vec3 low, high;  ///< corners of the box; infinite for a half-space
  /// true: the solid is known to reach all sides of the box; false: it lies inside and may not
  /// reach them
  bool attained = false;
};
/// Returns the box of a solid or a set of solids. A part that cuts off a whole side makes the box
/// smaller. A cut solid is known to reach a side if one of many points within 1/4 % of the width
/// from that side is inside.
SolidExtent extent_of(const Region& solid);

/// The regions of a scene, by index (RegionId); index 0 is "all". An index stays valid.
class Regions {
 public:
  Regions();
  /// Adds a region under a name or an expression.
  RegionId add(std::shared_ptr<const Region> region, std::string name);
  const Region& operator[](RegionId id) const { return *regions_[id.index].region; }
  const std::string& name(RegionId id) const {
    return regions_[id.index].name;
  }  ///< name or expression in the scene, for messages
  /// Returns the region of this name; nothing if there is none.
  std::optional<RegionId> find(const std::string& name) const;
  std::vector<std::string> names() const;
  std::size_t size() const { return regions_.size(); }

  /// Returns a Shape of a solid region for a lattice plugin; valid as long as this object.
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
