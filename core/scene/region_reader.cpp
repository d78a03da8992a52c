#include <geometry/primitives.hpp>
#include <scene/expectation.hpp>
#include <scene/option_reader.hpp>
#include <scene/region_reader.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

namespace hyperlattice {

namespace {

// levels of nested sets, which are evaluated for every particle
constexpr std::size_t most_levels = 64;
constexpr std::size_t most_suggestions = 100;  // faults for which similar names are searched
// regions of one set after all names are replaced; each may be evaluated for every particle
constexpr std::size_t most_regions = 10'000;

const std::string expected_region =
    "a region: a name, or an object with one key out of box, sphere, hollow_sphere, cylinder, "
    "half_space, stl, voxels, union, intersection, "
    "difference";

std::vector<std::string> expression_keys() {
  std::vector<std::string> keys;
  for (const Primitive& primitive : primitives()) keys.emplace_back(primitive.name);
  for (const SetOperation& operation : set_operations) keys.emplace_back(operation.name);
  return keys;
}

bool bounded(const Region& solid) {
  const auto finite = [](Vec3 p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
  };
  return finite(solid.low) && finite(solid.high);
}

bool inverted(const Region& region) {
  return region.low.x > region.high.x || region.low.y > region.high.y ||
         region.low.z > region.high.z;
}

}  // namespace

RegionReader::RegionReader(const Json& named, Regions& regions, Faults& faults,
                           std::deque<std::string>& texts, const Origins& origins,
                           const Variables& variables)
    : named_(named),
      regions_(regions),
      faults_(faults),
      texts_(texts),
      origins_(origins),
      variables_(variables) {
  for (const auto& item : named_.items()) expressions_.emplace(item.key(), &item.value());
  if (const auto all = regions_.find("all")) ids_.emplace("all", *all);
}

bool RegionReader::knows(const std::string& name) const {
  return expressions_.contains(name) || built_in_region(name) != nullptr;
}

std::vector<std::string> RegionReader::names() const {
  std::vector<std::string> all = built_in_region_names();
  for (const auto& item : named_.items()) all.push_back(item.key());
  return all;
}

void RegionReader::read_named(Json& resolved) {
  for (const auto& item : named_.items()) {
    const std::string& name = item.key();
    const std::string pointer = member("/regions", name);
    if (built_in_region(name))
      faults_.add(pointer, "", "a name of its own; \"" + name + "\" is built in");
    else if (read_name(name, pointer))
      resolved[name] = Json::parse(resolved_.at(name));
  }
}

std::shared_ptr<const Region> RegionReader::read_name(const std::string& name,
                                                      const std::string& pointer) {
  if (auto region = built_in_region(name)) return region;
  if (const auto found = done_.find(name); found != done_.end()) return found->second;
  const auto expression = expressions_.find(name);
  if (expression == expressions_.end()) {
    const std::vector<std::string> candidates =
        faults_.size() < most_suggestions ? names() : built_in_region_names();
    faults_.add(pointer, shown(name), "the name of a region" + did_you_mean(name, candidates));
    return nullptr;
  }
  if (std::find(under_way_.begin(), under_way_.end(), name) != under_way_.end()) {
    faults_.add(pointer, shown(name), "a region that does not refer to itself");
    return nullptr;
  }
  if (!can_nest(member("/regions", name), level_ + 1)) return nullptr;
  under_way_.push_back(name);
  ++level_;
  Json resolved;
  auto region = read(*expression->second, member("/regions", name), resolved);
  --level_;
  under_way_.pop_back();
  done_[name] = region;
  resolved_[name] = resolved.dump();
  if (region) add(region, name);
  return region;
}

RegionReader::Extent RegionReader::extent_of(const std::shared_ptr<const Region>& region) const {
  const auto found = extents_.find(region);
  return found == extents_.end() ? Extent() : found->second;
}

RegionId RegionReader::add(const std::shared_ptr<const Region>& region, const std::string& name) {
  const RegionId id = regions_.add(region, name);
  ids_.emplace(name, id);
  return id;
}

/// Adds only one fault, also if many regions are nested too deeply.
bool RegionReader::can_nest(const std::string& pointer, std::size_t depth) {
  if (depth <= most_levels) return true;
  if (!std::exchange(too_deep_, true))
    faults_.add(pointer, "",
                fmt::format("at most {} levels of regions within regions", most_levels));
  return false;
}

std::shared_ptr<const Region> RegionReader::read(const Json& expression, const std::string& pointer,
                                                 Json& resolved) {
  resolved = expression;
  if (expression.is_string()) return read_name(expression.get<std::string>(), pointer);
  if (!expression.is_object() || expression.size() != 1) {
    faults_.add(pointer, shown(expression), expected_region);
    return nullptr;
  }
  const std::string key = expression.begin().key();
  const Json& content = expression.begin().value();
  const std::string inner = member(pointer, key);
  for (const SetOperation& operation : set_operations)
    if (key == operation.name) return read_set(operation, content, inner, resolved[key]);
  const auto keys = expression_keys();
  if (std::find(keys.begin(), keys.end(), key) != keys.end())
    return read_primitive(key, content, inner, resolved[key]);
  faults_.add(inner, shown(content), expected_region + did_you_mean(key, keys));
  return nullptr;
}

std::shared_ptr<const Region> RegionReader::read_primitive(const std::string& key,
                                                           const Json& parameters,
                                                           const std::string& pointer,
                                                           Json& resolved) {
  const auto all = primitives();
  const Primitive& primitive =
      *std::find_if(all.begin(), all.end(), [&](const Primitive& p) { return p.name == key; });
  resolved = Json::object();
  if (!parameters.is_object()) {
    faults_.add(pointer, shown(parameters),
                fmt::format("an object with the parameters of {}", key));
    return nullptr;
  }
  OptionReader reader(parameters, pointer, Reading{faults_, *this, texts_});
  const OptionsPointer options = reader.fill(primitive.options, resolved);
  reader.reject_unknown();
  if (!options) return nullptr;
  try {
    return std::make_shared<Region>(primitive.make(options.get()));
  } catch (const OutsideError&) {
    throw;
  } catch (const std::runtime_error& error) {
    faults_.add(member(pointer, path_option), shown(parameters[std::string(path_option)]),
                fmt::format("a file with {}; {}", primitive.file_holds, error.what()));
  }
  return nullptr;
}

std::shared_ptr<const Region> RegionReader::read_set(const SetOperation& operation,
                                                     const Json& parts, const std::string& pointer,
                                                     Json& resolved) {
  if (!parts.is_array() || parts.empty()) {
    faults_.add(pointer, shown(parts), "a list of regions");
    return nullptr;
  }
  std::vector<std::shared_ptr<const Region>> regions;
  for (std::size_t n = 0; n < parts.size(); ++n)
    if (auto region = read(parts[n], member(pointer, n), resolved[n]))
      regions.push_back(std::move(region));
  if (regions.size() != parts.size()) return nullptr;
  Extent whole;
  for (const auto& region : regions) {
    const Extent part = extent_of(region);
    whole.size += part.size;
    whole.depth = std::max(whole.depth, part.depth + 1);
  }
  if (!can_nest(pointer, whole.depth)) return nullptr;
  if (whole.size > most_regions) {
    faults_.add(pointer, "",
                fmt::format("a set of at most {} regions; with all names written out it has {}",
                            most_regions, whole.size));
    return nullptr;
  }
  auto set = make_set(operation.kind, std::move(regions));
  extents_[set] = whole;
  if (set->is_solid() && inverted(*set)) {
    faults_.add(pointer, shown(parts), "parts that overlap");
    return nullptr;
  }
  return set;
}

std::optional<RegionId> RegionReader::read_id(const Json& expression, const std::string& pointer,
                                              Json& resolved) {
  auto region = read(expression, pointer, resolved);
  if (!region) return std::nullopt;
  const std::string name = resolved.is_string() ? resolved.get<std::string>() : resolved.dump();
  if (const auto known = ids_.find(name); known != ids_.end()) return known->second;
  return add(region, name);
}

const Shape* RegionReader::read_shape(const Json& expression, const std::string& pointer,
                                      Json& resolved) {
  auto region = read(expression, pointer, resolved);
  if (!region) return nullptr;
  if (!region->is_solid()) {
    faults_.add(
        pointer, shown(expression),
        "a solid; surfaces and faces have no volume, and \"all\" is what the lattice fills");
    return nullptr;
  }
  if (!bounded(*region)) {
    faults_.add(pointer, shown(expression),
                "a bounded solid; a half-space needs an intersection with one");
    return nullptr;
  }
  return regions_.shape(std::move(region));
}

}  // namespace hyperlattice
