#include <report/differences.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>

namespace hyperlattice::report {

namespace {

const Json none;

/// The values at one place, one for each scene; null if the scene has none.
using Values = std::vector<const Json*>;

bool all(const Values& values, bool (*holds)(const Json&)) {
  return std::all_of(values.begin(), values.end(),
                     [&](const Json* value) { return holds(*value); });
}

bool are_alike(const Values& values) {
  return std::all_of(values.begin(), values.end(),
                     [&](const Json* value) { return *value == *values.front(); });
}

const Json& in(const Json& object, const std::string& key) {
  const auto found = object.find(key);
  return found == object.end() ? none : *found;
}

/// Returns whether a value is an array with arrays or objects in it. Other arrays, such as vectors,
/// are compared as one value.
bool has_structure(const Json& value) {
  return value.is_array() && std::any_of(value.begin(), value.end(),
                                         [](const Json& part) { return part.is_structured(); });
}

class Comparison {
 public:
  void compare(const std::string& pointer, const Values& values) {
    if (are_alike(values)) return;
    if (all(values, [](const Json& value) { return value.is_object(); }) &&
        are_alike(at(values, "type")))
      return compare_members(pointer, values);
    if (all(values, has_structure)) return compare_elements(pointer, values);
    Difference& difference = found_.emplace_back(Difference{pointer, {}});
    for (const Json* value : values) difference.values.push_back(*value);
  }
  std::vector<Difference> take() { return std::move(found_); }

 private:
  static Values at(const Values& values, const std::string& key) {
    Values members;
    for (const Json* value : values) members.push_back(&in(*value, key));
    return members;
  }

  void compare_members(const std::string& pointer, const Values& values) {
    std::vector<std::string> keys;
    for (const Json* value : values)
      for (const auto& [key, unused] : value->items())
        if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
    for (const std::string& key : keys) compare(member(pointer, key), at(values, key));
  }

  void compare_elements(const std::string& pointer, const Values& values) {
    std::size_t most = 0;
    for (const Json* value : values) most = std::max(most, value->size());
    for (std::size_t n = 0; n < most; ++n) {
      Values elements;
      for (const Json* value : values) elements.push_back(n < value->size() ? &(*value)[n] : &none);
      compare(member(pointer, n), elements);
    }
  }

  std::vector<Difference> found_;
};

}  // namespace

std::vector<Difference> differences(const std::vector<Json>& scenes) {
  Values known;
  for (const Json& scene : scenes)
    if (!scene.is_null()) known.push_back(&scene);
  if (known.empty()) return {};
  Comparison comparison;
  comparison.compare("", known);
  std::vector<Difference> found = comparison.take();
  for (Difference& difference : found)
    for (std::size_t s = 0; s < scenes.size(); ++s)
      if (scenes[s].is_null())
        difference.values.insert(difference.values.begin() + static_cast<std::ptrdiff_t>(s),
                                 Json());
  return found;
}

}  // namespace hyperlattice::report
