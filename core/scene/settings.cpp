#include <scene/settings.hpp>
#include <scene/stage_names.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

#include <charconv>
#include <optional>

namespace hyperlattice {

namespace {

/// Returns the keys of a JSON pointer, with "~1" and "~0" decoded; nothing if the text is no
/// pointer.
std::optional<std::vector<std::string>> keys_of(std::string_view pointer) {
  if (pointer.empty() || pointer.front() != '/') return std::nullopt;
  std::vector<std::string> keys;
  for (std::size_t n = 0; n < pointer.size(); ++n) {
    if (pointer[n] == '/') {
      keys.emplace_back();
    } else if (pointer[n] == '~') {
      if (++n == pointer.size() || (pointer[n] != '0' && pointer[n] != '1')) return std::nullopt;
      keys.back() += pointer[n] == '0' ? '~' : '/';
    } else {
      keys.back() += pointer[n];
    }
  }
  return keys;
}

std::optional<std::size_t> index_of(std::string_view key) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), index);
  if (error != std::errc() || end != key.data() + key.size() ||
      (key.size() > 1 && key.front() == '0'))
    return std::nullopt;
  return index;
}

/// Returns the member to set; null if it cannot exist, with what was expected in `expected`.
Json* find(Json& scene, const std::vector<std::string>& keys, std::string& expected) {
  Json* at = &scene;
  std::string pointer;
  for (std::size_t n = 0; n < keys.size(); ++n) {
    const std::string& key = keys[n];
    const bool last = n + 1 == keys.size();
    if (at->is_array()) {
      const std::size_t size = at->size();
      const auto index = last && key == "-" ? size : index_of(key);
      if (!index || *index > size || (*index == size && !last)) {
        expected = fmt::format("an index into {}, which has {} {}",
                               pointer.empty() ? "the scene" : pointer, size,
                               size == 1 ? "entry" : "entries");
        return nullptr;
      }
      at = *index == size ? &at->emplace_back() : &(*at)[*index];
    } else if (at->is_object()) {
      if (!last && !at->contains(key)) {
        std::vector<std::string> present;
        for (const auto& item : at->items()) present.push_back(item.key());
        const std::string near = nearest(key, present);
        expected = fmt::format("an existing parent; {} has no \"{}\"",
                               pointer.empty() ? "the scene" : pointer, key) +
                   (near.empty() ? "" : fmt::format(", did you mean \"{}\"?", near));
        return nullptr;
      }
      at = &(*at)[key];
    } else {
      expected = fmt::format("an existing parent; {} is {}, which has no members",
                             pointer.empty() ? "the scene" : pointer, shown(*at));
      return nullptr;
    }
    pointer = member(pointer, key);
  }
  return at;
}

}  // namespace

Json value_of(const std::string& text) {
  Json value;
  Faults ignored;
  if (parse_json(text, value, ignored) && ignored.empty()) return value;
  return text;
}

std::string set_value(Json& document, std::string_view pointer, const Json& value) {
  const auto keys = keys_of(pointer);
  if (!keys) return "a JSON pointer such as /pipeline/0/spacing";
  std::string expected;
  if (Json* place = find(document, *keys, expected)) *place = value;
  return expected;
}

void apply_settings(Json& scene, const std::vector<std::string>& settings, Faults& faults) {
  for (const std::string& setting : settings) {
    const auto equals = setting.find('=');
    const std::string place = setting.substr(0, equals);
    const auto slash = place.find('/');
    if (equals == std::string::npos || slash == std::string::npos ||
        !keys_of(place.substr(slash))) {
      faults.add("--set", shown(setting),
                 "/pointer=value with a JSON pointer such as /pipeline/0/spacing=0.001, or "
                 "name/option=value with the name or the type of a stage");
      continue;
    }
    std::string pointer = place;
    if (slash > 0) {
      const NamedStage stage = find_stage(scene, place.substr(0, slash));
      if (stage.pointer.empty()) {
        faults.add("--set " + place, "", stage.expected);
        continue;
      }
      pointer = stage.pointer + place.substr(slash);
    }
    const Json value = value_of(setting.substr(equals + 1));
    if (value.is_string() && !is_utf8(value.get_ref<const std::string&>())) {
      faults.add("--set " + place, shown(value), "text in UTF-8");
      continue;
    }
    if (const std::string expected = set_value(scene, pointer, value); !expected.empty())
      faults.add("--set " + place, shown(value), expected);
  }
}

}  // namespace hyperlattice
