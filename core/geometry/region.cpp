#include <geometry/region.hpp>

#include <algorithm>

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

}  // namespace

bool Region::is_solid() const {
  if (kind == Kind::solid) return true;
  return !parts.empty() && std::all_of(parts.begin(), parts.end(), [](const auto& part) { return part->is_solid(); });
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

std::shared_ptr<const Region> make_set(Region::Kind kind, std::vector<std::shared_ptr<const Region>> parts) {
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
  auto& kept = shapes_.emplace_back(std::make_unique<std::pair<std::shared_ptr<const Region>, Shape>>());
  kept->first = std::move(region);
  const Region& solid = *kept->first;
  kept->second = {&solid, [](const void* self, Vec3 point) noexcept { return static_cast<const Region*>(self)->contains(point); }, solid.low,
                  solid.high, solid.anchor};
  return &kept->second;
}

}  // namespace hyperlattice
