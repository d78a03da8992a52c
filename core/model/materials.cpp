#include <model/build.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>

namespace hyperlattice {

namespace {

constexpr std::uint8_t no_material = 255;

LatticeFacts facts_of(const Body& body) {
  LatticeFacts facts;
  facts.spacing = body.grid.spacing;
  facts.site_volume = body.grid.site_volume;
  facts.membrane_distance = body.grid.membrane_distance;
  facts.neighbours = body.neighbours;
  facts.spring_classes = body.grid.spring_classes;
  facts.particles = body.particles;
  std::copy(std::begin(body.springs), std::end(body.springs), std::begin(facts.springs));
  if (body.cells.empty()) return facts;
  facts.particles = body.cells.count();  // the shares of a cell sum to one particle, and to one spring to each neighbour
  std::fill(std::begin(facts.springs), std::end(facts.springs), 0);
  for (const Neighbour& to : body.neighbours) facts.springs[to.spring_class] += body.cells.count();
  return facts;
}

Material make_material(const Stage& stage, const Body& body) {
  Material material;
  material.stage = &stage;
  material.component = make_component(stage);
  if (stage.failure) {
    material.failure_stage = stage.failure.get();
    material.failure = make_component(*stage.failure);
  }
  Objection refused;
  if (!stage.functions<MaterialFunctions>().constants(material.component.get(), facts_of(body), material.constants, refused.why))
    throw refusal(stage, refused.sentence);
  const MaterialConstants& constants = material.constants;
  if (!(constants.density > 0 && constants.base_stiffness > 0 && std::isfinite(constants.density) && std::isfinite(constants.base_stiffness)))
    throw refusal(stage, "its density or its stiffness came out as not positive or not finite");
  material.mass = constants.density * body.grid.site_volume;
  return material;
}

/// Materials of one body share their kernels, so they need one law.
void check_laws(const std::vector<Material>& materials, Faults& faults) {
  const std::string_view law = materials[0].stage->functions<MaterialFunctions>().law;
  for (const Material& material : materials) {
    const std::string_view other = material.stage->functions<MaterialFunctions>().law;
    if (other != law)
      faults.add(material.stage->pointer, material.stage->component->type(),
                 fmt::format("a material with the law \"{}\" of {}, because one body has one law; this one has \"{}\"", law,
                             materials[0].stage->pointer, other));
  }
}

/// Later stages take over the particles of earlier ones.
void assign(Model& model, RegionIndex& regions, Faults& faults) {
  std::vector<std::uint8_t> material_of(model.body.particles, no_material);
  std::vector<std::uint64_t> count(no_material + std::size_t{1});
  for (std::size_t n = 0; n < model.materials.size(); ++n) {
    const Stage& stage = *model.materials[n].stage;
    const std::span<const Particle> particles = regions.particles(stage.region);
    if (particles.empty()) faults.add(stage.pointer + "/region", "", regions.expected_particles(stage.region));
    for (const Particle particle : particles) material_of[particle] = static_cast<std::uint8_t>(n);
  }
  if (!faults.empty()) return;
  for (const std::uint8_t material : material_of) ++count[material];
  for (std::size_t n = 0; n < model.materials.size(); ++n)
    if (count[n] == 0) faults.add(model.materials[n].stage->pointer + "/region", "", "particles of its own; later materials take all of this one's");
  if (count[no_material] > 0) {
    const auto first = std::find(material_of.begin(), material_of.end(), no_material) - material_of.begin();
    const Vec3 at = model.body.position(static_cast<Particle>(first));
    faults.add(
        "/pipeline", "",
        fmt::format("a material for every particle; {} have none, the first at ({:.6g}, {:.6g}, {:.6g}) m", count[no_material], at.x, at.y, at.z));
  }
  if (faults.empty() && model.materials.size() > 1) model.material_of = std::move(material_of);
}

}  // namespace

void add_materials(Model& model, RegionIndex& regions, Faults& faults) {
  const std::vector<const Stage*> stages = model.scene->of(Family::materials);
  if (stages.empty()) faults.add("/pipeline", "", "a stage that is a material");
  if (stages.size() >= no_material) faults.add(stages.back()->pointer, "", fmt::format("at most {} materials", no_material - 1));
  if (!faults.empty()) return;
  for (const Stage* stage : stages) try {
      model.materials.push_back(make_material(*stage, model.body));
    } catch (const InputError& error) {
      add_all(faults, error);
    }
  if (!faults.empty()) return;
  check_laws(model.materials, faults);
  assign(model, regions, faults);
}

}  // namespace hyperlattice
