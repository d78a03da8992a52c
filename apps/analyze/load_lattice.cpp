#include <analyze/load_lattice.hpp>
#include <model/build.hpp>
#include <scene/option_reader.hpp>
#include <scene/settings.hpp>

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>
#include <nlohmann/json.hpp>

#include <stdexcept>

namespace hyperlattice {

namespace {

constexpr const char* where = "--lattice";

/// Returns the lattice component of this type. Throws InputError if there is none, with a
/// suggestion for "cubic" alone.
const Component& find_lattice(Host& host, const std::string& type) {
  if (const Component* component = host.find(type);
      component != nullptr && component->info.family == Family::lattices)
    return *component;
  if (host.refused(type)) throw OutsideError(host.why_not(type));
  std::vector<std::string> lattices;
  for (const std::string& known : host.known_types())
    if (known.starts_with("lattices.")) lattices.push_back(known);
  const std::string near = nearest(type, lattices);
  const std::string found = lattices.empty() ? "" : fmt::format(": {}", fmt::join(lattices, ", "));
  throw InputError({{where, type,
                     "a lattice that can be found" + found +
                         (near.empty() ? "" : "; did you mean '" + near + "'?")}});
}

}  // namespace

LatticeGeometry load_lattice(Host& host, const std::string& type,
                             const std::vector<std::string>& more) {
  Stage stage;
  stage.component = &find_lattice(host, type);
  stage.pointer = where;

  Json options =
      Json::parse(R"({"spacing": 1, "shape": {"box": {"low": [0, 0, 0], "high": [4, 4, 4]}}})");
  const Json named = Json::object();
  Faults faults;
  for (const std::string& option : more) {
    const auto equals = option.find('=');
    if (equals == std::string::npos || equals == 0)
      throw InputError(
          {{"--option", option, "name=value, with the name of one of the lattice's options"}});
    if (const std::string wrong = set_value(options, fmt::format("/{}", option.substr(0, equals)),
                                            value_of(option.substr(equals + 1)));
        !wrong.empty())
      throw InputError({{"--option", option, wrong}});
  }
  Regions regions;
  std::deque<std::string> texts;
  RegionReader region_reader(named, regions, faults, texts);
  Json resolved;
  OptionReader reader(options, where, {faults, region_reader, texts});
  stage.options =
      reader.fill(option_set(stage.component->info, stage.component->path.c_str()), resolved);
  reader.reject_unknown();
  if (!faults.empty() && !more.empty()) faults.throw_if_any();
  if (!faults.empty())
    throw InputError(
        {{where, type, "a lattice that is described by a spacing and a shape, and by --option"}});
  for (const std::string& warning : faults.warnings()) spdlog::warn("warning: {}", warning);

  const ComponentPointer lattice = make_component(stage);
  try {
    const auto body = std::make_shared<const Body>(
        build_body(stage.functions<LatticeFunctions>(), lattice.get(), true, stage.component));
    LatticeGeometry geometry = geometry_from(*body);
    if (geometry.listed) geometry.listed = {body, &body->listed};  // geometry now owns the body
    return geometry;
  } catch (const std::invalid_argument& refused) {
    throw refusal(stage, refused.what());
  }
}

}  // namespace hyperlattice
