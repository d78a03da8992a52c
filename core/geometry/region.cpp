#include <geometry/region.hpp>
#include <geometry/volume_share.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace hyperlattice {

namespace {

struct Plain {
  const char* name;
  Region::Kind kind;
  int direction;  // as in face_normals
};
constexpr Plain built_in[] = {{"all", Region::Kind::all, 0},
                              {"surface", Region::Kind::surface, 0},
                              {"inner_surface", Region::Kind::inner_surface, 0},
                              {"outer_surface", Region::Kind::outer_surface, 0},
                              {"x_min", Region::Kind::face, 0},
                              {"x_max", Region::Kind::face, 1},
                              {"y_min", Region::Kind::face, 2},
                              {"y_max", Region::Kind::face, 3},
                              {"z_min", Region::Kind::face, 4},
                              {"z_max", Region::Kind::face, 5}};

Vec3 lower(Vec3 a, Vec3 b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3 upper(Vec3 a, Vec3 b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }
bool is_finite(Vec3 v) { return std::isfinite(norm(v)); }

constexpr int axes[] = {0, 1, 2};

/// Returns whether a solid fills its bounding box: a box, or a half-space along an axis.
bool fills_its_box(const Region& region) {
  if (region.primitive == "box") return true;
  return region.primitive == "half_space" &&
         std::any_of(std::begin(axes), std::end(axes), [&](int axis) {
           return std::isfinite(region.low[axis]) || std::isfinite(region.high[axis]);
         });
}

/// Removes from the box what a part cuts off over a whole side.
void cut(SolidExtent& extent, const Region& part) {
  if (part.kind == Region::Kind::set_union)
    for (const auto& piece : part.parts) cut(extent, *piece);
  if (!fills_its_box(part)) return;
  const auto covers = [&](int axis) {
    return part.low[axis] <= extent.low[axis] && part.high[axis] >= extent.high[axis];
  };
  for (const int along : axes) {
    if (!std::all_of(std::begin(axes), std::end(axes),
                     [&](int axis) { return axis == along || covers(axis); }))
      continue;
    if (part.low[along] <= extent.low[along])
      extent.low[along] = std::clamp(part.high[along], extent.low[along], extent.high[along]);
    else if (part.high[along] >= extent.high[along])
      extent.high[along] = std::clamp(part.low[along], extent.low[along], extent.high[along]);
  }
}

/// Returns whether at least one of many evenly spaced points close to a side is inside.
bool reaches(const Region& solid, const SolidExtent& extent, int along, bool upper_side) {
  constexpr int points = 24;  // number along each edge of the side
  // distance from the side over the width; some points are as near to the summit of a round side
  constexpr double in_from_the_side = 2.5e-3;
  const Vec3 size = extent.high - extent.low;
  const auto at = [&](int n, int axis) {
    return extent.low[axis] + (n + 0.5) / points * size[axis];
  };
  const int one = (along + 1) % 3, other = (along + 2) % 3;
  Vec3 point;
  point[along] = upper_side ? extent.high[along] - in_from_the_side * size[along]
                            : extent.low[along] + in_from_the_side * size[along];
  for (int i = 0; i < points; ++i)
    for (int j = 0; j < points; ++j) {
      point[one] = at(i, one);
      point[other] = at(j, other);
      if (solid.contains(point)) return true;
    }
  return false;
}

bool reaches_all_sides(const Region& solid, const SolidExtent& extent) {
  if (!is_finite(extent.low) || !is_finite(extent.high)) return false;
  for (const int along : axes)
    if (!reaches(solid, extent, along, false) || !reaches(solid, extent, along, true)) return false;
  return true;
}

}  // namespace

bool Region::is_solid() const {
  if (kind == Kind::solid) return true;
  return !parts.empty() &&
         std::all_of(parts.begin(), parts.end(), [](const auto& part) { return part->is_solid(); });
}

bool Region::contains(Vec3 point) const {
  const auto holds = [point](const auto& part) { return part->contains(point); };
  switch (kind) {
    case Kind::solid:
      return inside(point);
    case Kind::set_union:
      return std::any_of(parts.begin(), parts.end(), holds);
    case Kind::intersection:
      return std::all_of(parts.begin(), parts.end(), holds);
    case Kind::difference:
      return holds(parts.front()) && std::none_of(parts.begin() + 1, parts.end(), holds);
    default:
      return false;
  }
}

std::shared_ptr<const Region> built_in_region(std::string_view name) {
  for (const Plain& plain : built_in)
    if (name == plain.name) {
      auto region = std::make_shared<Region>();
      region->kind = plain.kind;
      region->direction = plain.direction;
      return region;
    }
  return nullptr;
}

const std::vector<std::string>& built_in_region_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Plain& plain : built_in) all.emplace_back(plain.name);
    return all;
  }();
  return names;
}

std::shared_ptr<const Region> make_set(Region::Kind kind,
                                       std::vector<std::shared_ptr<const Region>> parts) {
  auto set = std::make_shared<Region>();
  set->kind = kind;
  set->parts = std::move(parts);
  if (!set->is_solid()) return set;
  const Region& first = *set->parts.front();
  set->low = first.low;
  set->high = first.high;
  set->anchor = first.anchor;
  set->centre = first.centre;
  if (kind == Region::Kind::difference) return set;
  for (const auto& part : set->parts) {
    const bool wider = kind == Region::Kind::set_union;
    set->low = wider ? lower(set->low, part->low) : upper(set->low, part->low);
    set->high = wider ? upper(set->high, part->high) : lower(set->high, part->high);
  }
  return set;
}

SolidExtent extent_of(const Region& solid) {
  SolidExtent extent{
      solid.low, solid.high,
      solid.kind == Region::Kind::solid && is_finite(solid.low) && is_finite(solid.high)};
  if (solid.parts.empty()) return extent;
  extent = extent_of(*solid.parts.front());
  for (auto part = solid.parts.begin() + 1; part != solid.parts.end(); ++part) {
    if (solid.kind == Region::Kind::difference) {
      cut(extent, **part);
      continue;
    }
    const SolidExtent other = extent_of(**part);
    const bool wider = solid.kind == Region::Kind::set_union;
    extent.low = wider ? lower(extent.low, other.low) : upper(extent.low, other.low);
    extent.high = wider ? upper(extent.high, other.high) : lower(extent.high, other.high);
    extent.attained = extent.attained && other.attained;
  }
  if (solid.kind != Region::Kind::set_union || !extent.attained)
    extent.attained = reaches_all_sides(solid, extent);
  return extent;
}

Regions::Regions() { add(built_in_region("all"), "all"); }

RegionId Regions::add(std::shared_ptr<const Region> region, std::string name) {
  regions_.push_back({std::move(region), std::move(name)});
  return {static_cast<std::uint32_t>(regions_.size() - 1)};
}

std::optional<RegionId> Regions::find(const std::string& name) const {
  for (std::uint32_t n = 0; n < regions_.size(); ++n)
    if (regions_[n].name == name) return RegionId{n};
  return std::nullopt;
}

std::vector<std::string> Regions::names() const {
  std::vector<std::string> all;
  for (const Entry& entry : regions_) all.push_back(entry.name);
  return all;
}

const Shape* Regions::shape(std::shared_ptr<const Region> region) {
  auto& kept =
      shapes_.emplace_back(std::make_unique<std::pair<std::shared_ptr<const Region>, Shape>>());
  kept->first = std::move(region);
  const Region& solid = *kept->first;
  kept->second = {&solid,
                  [](const void* self, Vec3 point) noexcept {
                    return static_cast<const Region*>(self)->contains(point);
                  },
                  solid.low,
                  solid.high,
                  solid.anchor,
                  [](const void* self, Vec3 low, double edge) noexcept {
                    return volume_share(*static_cast<const Region*>(self), {low, edge});
                  }};
  return &kept->second;
}

}  // namespace hyperlattice
