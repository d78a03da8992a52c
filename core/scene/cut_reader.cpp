#include <scene/cut_reader.hpp>
#include <scene/expectation.hpp>
#include <scene/value_reader.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace hyperlattice {

namespace {

std::vector<std::string> names_of_cuts() {
  std::vector<std::string> names;
  for (const CutKind& kind : cut_kinds()) names.emplace_back(kind.name);
  return names;
}

/// Reads the corners of a polygon; nothing after faults.
std::optional<std::vector<Vec3>> read_corners(const Json& parameters, const std::string& pointer,
                                              Reading reading, Json& resolved) {
  const std::string key(corners_option), at = member(pointer, key);
  const auto given = parameters.find(key);
  if (given == parameters.end() || !given->is_array() || given->size() < 3) {
    reading.faults.add(at, given == parameters.end() ? "" : shown(*given),
                       "a list of at least three corners, each a list of three lengths");
    return std::nullopt;
  }
  std::vector<Vec3> corners;
  corners.reserve(given->size());
  Json in_si = Json::array();
  for (std::size_t n = 0; n < given->size(); ++n) {
    ReadValue value;
    Json corner;
    if (!read_value(corner_option(), (*given)[n], member(at, n), reading, value, corner)) continue;
    corners.push_back({value.numbers[0], value.numbers[1], value.numbers[2]});
    in_si.push_back(std::move(corner));
  }
  if (corners.size() < given->size()) return std::nullopt;
  resolved[key] = std::move(in_si);
  return corners;
}

std::optional<Cut> read_kind(const CutKind& kind, const Json& parameters,
                             const std::string& pointer, Reading reading, Json& resolved) {
  resolved = Json::object();
  if (!parameters.is_object()) {
    reading.faults.add(pointer, shown(parameters),
                       fmt::format("an object with the parameters of {}", kind.name));
    return std::nullopt;
  }
  std::vector<std::string> keys;
  if (kind.has_corners) keys.emplace_back(corners_option);
  OptionReader reader(parameters, pointer, reading, std::move(keys));
  const OptionsPointer options = reader.fill(kind.options, resolved);
  reader.reject_unknown();
  std::optional<std::vector<Vec3>> corners{std::vector<Vec3>()};
  if (kind.has_corners) corners = read_corners(parameters, pointer, reading, resolved);
  if (!options || !corners) return std::nullopt;
  try {
    return Cut{pointer, kind.make(options.get(), *corners)};
  } catch (const OutsideError&) {
    throw;
  } catch (const std::runtime_error& error) {
    const std::string option(kind.has_corners ? corners_option : "file");
    reading.faults.add(member(pointer, option), shown(parameters[option]),
                       kind.has_corners
                           ? fmt::format("the corners of a flat polygon; {}", error.what())
                           : fmt::format("a file with {}; {}", kind.file_holds, error.what()));
  }
  return std::nullopt;
}

std::optional<Cut> read_cut(const Json& given, const std::string& pointer, Reading reading,
                            Json& resolved) {
  const std::vector<std::string> names = names_of_cuts();
  const std::string expected =
      fmt::format("a surface: an object with one key out of {}", fmt::join(names, ", "));
  if (!given.is_object() || given.size() != 1) {
    reading.faults.add(pointer, shown(given), expected);
    return std::nullopt;
  }
  const std::string key = given.begin().key();
  const auto kinds = cut_kinds();
  const auto kind =
      std::find_if(kinds.begin(), kinds.end(), [&](const CutKind& k) { return k.name == key; });
  if (kind != kinds.end())
    return read_kind(*kind, given.begin().value(), member(pointer, key), reading, resolved[key]);
  reading.faults.add(member(pointer, key), shown(given.begin().value()),
                     expected + did_you_mean(key, names));
  return std::nullopt;
}

}  // namespace

Option corner_option() {
  Option option;
  option.name = corners_option;
  option.unit = "m";
  option.help = "a corner";
  option.kind = OptionKind::vector;
  return option;
}

std::optional<std::vector<Cut>> read_cuts(const Json& given, const std::string& pointer,
                                          Reading reading, Json& resolved) {
  if (!given.is_array()) {
    reading.faults.add(pointer, shown(given), "a list of surfaces");
    return std::nullopt;
  }
  std::vector<Cut> cuts;
  resolved = Json::array();
  for (std::size_t n = 0; n < given.size(); ++n) {
    Json cut_resolved;
    auto cut = read_cut(given[n], member(pointer, n), reading, cut_resolved);
    if (!cut) continue;
    cuts.push_back(std::move(*cut));
    resolved.push_back(std::move(cut_resolved));
  }
  if (cuts.size() < given.size()) return std::nullopt;
  return cuts;
}

}  // namespace hyperlattice
