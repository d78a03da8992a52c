#include <base/content_hash.hpp>
#include <plan/body_facts.hpp>
#include <scene/common_options.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace hyperlattice {

namespace {

std::string places(const Body& body) {
  ContentHash hash;
  const auto add = [&](Vec3 v) { hash.add(fmt::format("{} {} {}\n", v.x, v.y, v.z)); };
  if (body.is_listed()) {
    for (const Vec3 place : body.listed.positions) add(place);
    return hash.text();
  }
  add(body.grid.origin);
  for (const Vec3 step : body.grid.basis) add(body.grid.spacing * step);
  for (const Run& run : body.runs)
    hash.add(fmt::format("{} {} {} {}\n", run.j, run.k, run.begin, run.end));
  return hash.text();
}

std::string springs(const Body& body) {
  ContentHash hash;
  for (const ListedSpring& spring : body.listed.springs)
    hash.add(fmt::format("{} {}\n", spring.a, spring.b));
  for (const Neighbour& to : body.neighbours)
    hash.add(fmt::format("{} {} {} {}\n", to.dx, to.dy, to.dz, to.spring_class));
  for (const CutSite& cut : body.cut_sites)
    hash.add(fmt::format("{} {}\n", cut.particle, cut.neighbours));
  return hash.text();
}

/// Returns the hash of which share and which material each particle has.
std::string kinds(const Model& model) {
  ContentHash hash;
  const bool has_shares = !model.body.cells.empty() || !model.body.listed.shares.empty();
  const bool has_kinds = !model.kinds.material_of.empty() || !model.kinds.mixtures.empty();
  for (Particle p = 0; (has_shares || has_kinds) && p < model.body.particles; ++p)
    hash.add(fmt::format("{} {}\n", model.body.share(p), model.kinds.of(p)));
  return hash.text();
}

template <class Of>
std::string types(const std::vector<Material>& materials, const Of& of) {
  std::vector<std::string> found;
  for (const Material& material : materials) of(material, found);
  return found.empty() ? "none" : fmt::format("{}", fmt::join(found, ", "));
}

std::string criteria_with_memory(const std::vector<Material>& materials) {
  return types(materials, [](const Material& material, std::vector<std::string>& found) {
    for (const Material::Criterion& one : material.failures)
      if (one.stage->functions<FailureFunctions>().memory > 0)
        found.push_back(one.stage->component->type());
  });
}

std::string surfaces(const std::vector<Material>& materials) {
  return types(materials, [](const Material& material, std::vector<std::string>& found) {
    if (material.surface) found.push_back(material.surface->stage->component->type());
  });
}

}  // namespace

BodyFacts body_facts(const Model& model) {
  const auto count = [](auto number) { return fmt::format("{}", number); };
  return {
      {"program", "hyperlattice " HYPERLATTICE_VERSION},
      {"instructions", model.springs.kernels().instructions},
      {"lattice", model.scene->of(Family::lattices).front()->component->type()},
      {"particles", count(model.body.particles)},
      {"springs", count(model.body.base_springs())},
      {"places of particles", places(model.body), true},
      {"ends of springs", springs(model.body), true},
      {"materials and shares of particles", kinds(model), true},
      {"materials", types(model.materials,
                          [](const Material& material, std::vector<std::string>& found) {
                            found.push_back(material.stage->component->type());
                          })},
      {"degrees of freedom", count(model.degrees_of_freedom)},
      {"distance in the fourth dimension", fmt::format("{} m", model.body.grid.membrane_distance)},
      {"precision",
       std::string(precision_names[static_cast<std::size_t>(model.springs.choice.precision)])},
      {"numbers that laws keep of a spring", count(model.springs.memory)},
      {"laws that soften", model.springs.softens ? "some" : "none"},
      {"criteria that keep numbers", criteria_with_memory(model.materials)},
      {"criteria with damage", surfaces(model.materials)}};
}

std::vector<std::string> differences(const BodyFacts& state, const BodyFacts& scene) {
  std::vector<std::string> found;
  for (const BodyFact& fact : scene) {
    const auto other = std::find_if(state.begin(), state.end(),
                                    [&](const BodyFact& one) { return one.name == fact.name; });
    if (other != state.end() && other->value == fact.value) continue;
    found.push_back(fact.is_hashed || other == state.end()
                        ? fmt::format("{}: not those of the scene", fact.name)
                        : fmt::format("{}: {} in the state, {} in the scene", fact.name,
                                      other->value, fact.value));
  }
  return found;
}

nlohmann::json body_facts_json(const BodyFacts& facts) {
  auto list = nlohmann::json::array();
  for (const BodyFact& fact : facts)
    list.push_back({{"name", fact.name}, {"value", fact.value}, {"is_hashed", fact.is_hashed}});
  return list;
}

BodyFacts read_body_facts(const nlohmann::json& json) {
  BodyFacts facts;
  for (const nlohmann::json& one : json)
    facts.push_back({one.at("name").get<std::string>(), one.at("value").get<std::string>(),
                     one.at("is_hashed").get<bool>()});
  return facts;
}

}  // namespace hyperlattice
