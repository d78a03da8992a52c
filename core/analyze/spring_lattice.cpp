#include <analyze/spring_lattice.hpp>
#include <model/build.hpp>
#include <scene/option_reader.hpp>

#include <nlohmann/json.hpp>

#include <stdexcept>

namespace hyperlattice {

namespace {

using Membrane = KernelChoice::Membrane;

constexpr const char* where = "--lattice";

/// The lattice component of that type; "cubic" alone will not do, but is understood.
const Component& find_lattice(Host& host, const std::string& type) {
  if (const Component* component = host.find(type); component != nullptr && component->info.family == Family::lattices) return *component;
  if (host.refused(type)) throw OutsideError(host.why_not(type));
  std::vector<std::string> lattices;
  for (const std::string& known : host.known_types())
    if (known.starts_with("lattices.")) lattices.push_back(known);
  const std::string near = nearest(type, lattices);
  throw InputError({{where, type, "a lattice that can be found, such as lattices.cubic" + (near.empty() ? "" : "; did you mean '" + near + "'?")}});
}

Membrane membrane_of(const MaterialConstants& constants) {
  if (constants.clamped) return constants.has_cross_springs() ? Membrane::clamped : Membrane::none;
  return constants.has_cross_springs() || constants.alpha_ratio != 0 ? Membrane::free : Membrane::none;
}

}  // namespace

LatticeGeometry geometry_from(const Grid& grid) {
  return {geometry_of(grid), grid.spring_classes, grid.spacing, grid.site_volume, grid.membrane_distance};
}

LatticeGeometry load_lattice(Host& host, const std::string& type) {
  Stage stage;
  stage.component = &find_lattice(host, type);
  stage.pointer = where;

  const Json options = Json::parse(R"({"spacing": 1, "shape": {"box": {"low": [0, 0, 0], "high": [4, 4, 4]}}})"), named = Json::object();
  Faults faults;
  Regions regions;
  std::deque<std::string> texts;
  RegionReader region_reader(named, regions, faults, texts);
  Json resolved;
  OptionReader reader(options, where, {faults, region_reader, texts});
  stage.options = reader.fill(option_set(stage.component->info), resolved);
  reader.reject_unknown();
  if (!faults.empty()) throw InputError({{where, type, "a lattice that is described by a spacing and a shape alone"}});

  const ComponentPointer lattice = make_component(stage);
  try {
    return geometry_from(build_body(stage.functions<LatticeFunctions>(), lattice.get()).grid);
  } catch (const std::invalid_argument& refused) {
    throw refusal(stage, refused.what());
  }
}

SpringLattice::SpringLattice(LatticeGeometry geometry, const MaterialConstants& constants)
    : geometry_(std::move(geometry)), base_stiffness_(constants.base_stiffness), membrane_(membrane_of(constants)) {
  for (std::uint32_t c = 0; c < geometry_.spring_classes; ++c)
    springs_.push_back({base_stiffness_, constants.cross_ratio[c] * base_stiffness_, infinity});
  alpha_ = constants.clamped ? 0 : constants.alpha_ratio * base_stiffness_;
}

}  // namespace hyperlattice
