#include <base/figures.hpp>
#include <plan/damage.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <numbers>

namespace hyperlattice {
namespace {

bool has_supports(const Model& model) {
  for (const Load& load : model.loads)
    for (const LoadedParticle& particle : load.particles)
      if (particle.displaced != 0 || particle.driven != 0) return true;
  return false;
}

/// Returns the middle one of the body's three edges, m: the width of a plate, the height of a beam.
double middle_size(const Vec3& size) {
  return std::max(std::min(size.x, size.y), std::min(std::max(size.x, size.y), size.z));
}

}  // namespace

nlohmann::json damage_json(const Model& model) {
  auto list = nlohmann::json::array();
  for (const Cohesive& of : model.cohesive)
    if (of.stage != nullptr)
      list.push_back(
          {{"material", model.materials[of.material].stage->pointer},
           {"type", of.stage->component->type()},
           {"strength", of.strength},
           {"fracture_energy", of.fracture_energy},
           {"length", of.length},
           {"spacings", of.length / model.body.grid.spacing},
           {"characteristic_length", of.characteristic_length()},
           {"final_opening", of.final_opening()},
           {"largest_strength", of.largest_admissible_strength()},
           {"least_strength_of_particles", of.least_strength},
           {"largest_strength_of_particles", of.largest_strength},
           {"intact_particles", std::count(model.intact.begin(), model.intact.end(), 1)}});
  return list;
}

std::vector<std::pair<std::string, std::string>> damage_lines(const nlohmann::json& entry) {
  const auto number = [&](const char* key) { return entry.at(key).get<double>(); };
  const auto intact = entry.at("intact_particles").get<std::uint64_t>();
  std::vector<std::pair<std::string, std::string>> lines{
      {entry.at("type").get<std::string>(),
       fmt::format("strength {:.4g} Pa, at most {:.4g} Pa with this length; fracture energy "
                   "{:.4g} J/m2",
                   number("strength"), number("largest_strength"), number("fracture_energy"))},
      {"length of damage",
       fmt::format("{:.4g} m, {:.3g} spacings; characteristic length {:.4g} m", number("length"),
                   number("spacings"), number("characteristic_length"))},
      {"crack without traction",
       fmt::format("from an opening of {:.4g} m", number("final_opening"))}};
  if (number("least_strength_of_particles") < number("largest_strength_of_particles"))
    lines.emplace_back("strengths of particles",
                       fmt::format("{:.4g} to {:.4g} Pa", number("least_strength_of_particles"),
                                   number("largest_strength_of_particles")));
  if (intact > 0)
    lines.emplace_back("particles without damage",
                       fmt::format("{} near supports", count_text(intact)));
  return lines;
}

void warn_of_damage(Plan& plan) {
  Model& model = *plan.model;
  constexpr double good = 5, round_off = 1e-9, least_zone = 0.9;
  const auto intact =
      static_cast<std::uint64_t>(std::count(model.intact.begin(), model.intact.end(), 1));
  const double spacing = model.body.grid.spacing;
  for (const Cohesive& of : model.cohesive) {
    if (of.stage == nullptr) continue;
    const auto warn = [&](const std::string& text) {
      model.warnings.push_back(
          fmt::format("{} ({}): {}", of.stage->component->type(), of.stage->pointer, text));
    };
    if (of.length < good * spacing * (1 - round_off))
      warn(
          fmt::format("its length of {:.4g} m is {:.3g} spacings: below 5 the paths of branches "
                      "may follow the lattice",
                      of.length, of.length / spacing));
    if (const double band = std::numbers::pi * of.length, size = middle_size(plan.body.size);
        band > size / 4)
      warn(
          fmt::format("the band of a crack, pi times its length, is {:.3g} m wide, more than a "
                      "quarter of the body's {:.3g} m",
                      band, size));
    if (const double zone = of.softening_zone(); zone < of.length * least_zone)
      warn(fmt::format(
          "the zone that softens at a crack's tip, about {:.3g} m long, is shorter than "
          "its length of {:.3g} m, as nu is near 1/2: cracks may take more than "
          "fracture_energy; expected a length of at most {:.3g} m",
          zone, of.length, zone));
    if (model.body.grid.boundary == Boundary::particles)
      warn(
          "with the boundary \"particles\" the stress at the body's surface is too low: its "
          "particles count in full and lack springs; \"cells\" has it right");
    if (of.intact_near_supports && 2 * intact > model.body.particles)
      warn(
          fmt::format("{} of {} particles are near prescribed motions, where no damage grows; "
                      "intact_near_supports: false lets it grow there",
                      count_text(intact), count_text(model.body.particles)));
    if (!of.intact_near_supports && has_supports(model))
      warn("intact_near_supports is false: the clamping at prescribed motions may start cracks");
  }
}

}  // namespace hyperlattice
