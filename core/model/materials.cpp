#include <model/build.hpp>
#include <model/spring_lattice.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>

namespace hyperlattice {

namespace {

constexpr std::uint8_t no_material = 255;

/// Returns the number of base springs of a class, the sum of their shares.
double whole_springs(const Body& body, std::uint32_t spring_class) {
  if (body.cells.empty()) return static_cast<double>(body.springs[spring_class]);
  const auto of_class = [spring_class](const Neighbour& to) {
    return to.spring_class == spring_class;
  };
  const auto neighbours = std::count_if(body.neighbours.begin(), body.neighbours.end(), of_class);
  // The shares of one cell sum to one spring to each neighbour.
  return static_cast<double>(neighbours) * static_cast<double>(body.cells.count());
}

LatticeFacts facts_of(const Model& model, const LatticeGeometry& geometry) {
  const Body& body = model.body;
  LatticeFacts facts = facts_of(geometry);
  facts.neighbours = body.neighbours;
  facts.allow_unstable = model.scene->allow_unstable;
  // The shares of one cell sum to one particle.
  facts.particles = body.cells.empty() ? body.particles : body.cells.count();
  for (std::uint32_t c = 0; c < facts.spring_classes; ++c)
    for (const NeighbourGeometry& n : geometry.neighbours)
      if (n.site.spring_class == c) {
        facts.squared_lengths +=
            facts.class_stiffness[c] * whole_springs(body, c) * n.rest_length * n.rest_length;
        break;  // all springs of a class have one length
      }
  if (!body.is_listed()) return facts;
  facts.particles =
      static_cast<std::uint64_t>(std::llround(geometry.volume / body.grid.site_volume));
  for (const ListedSpring& spring : body.listed.springs) {
    const double length = norm(body.listed.positions[spring.b] - body.listed.positions[spring.a]);
    facts.lengths += spring.stiffness * length;
    facts.squared_lengths += spring.stiffness * length * length;
    facts.cubed_lengths += spring.stiffness * length * length * length;
  }
  return facts;
}

/// Throws InputError if a constant of the material has no valid value. Constants of the law may be
/// infinite: a limit that is never reached.
void check_constants(const Stage& stage, const MaterialConstants& constants, double spacing) {
  if (!(constants.density > 0 && constants.base_stiffness > 0 && std::isfinite(constants.density) &&
        std::isfinite(constants.base_stiffness)))
    throw refusal(stage, "its density or its stiffness came out as not positive or not finite");
  bool good = constants.clamped || std::isfinite(constants.alpha_ratio);
  good = good && std::isfinite(constants.volumetric);
  for (std::uint32_t c = 0; c < max_spring_classes; ++c) {
    good = good && std::isfinite(constants.cross_ratio[c]);
    for (const auto& of_law : constants.law[c])
      for (const double number : of_law) good = good && !std::isnan(number);
  }
  if (!good)
    throw refusal(stage,
                  "the stiffness of its cross springs, its K_v or a constant of its law came out "
                  "as no number");
  if (const double energy = largest_energy(constants, spacing); !(energy <= most_energy))
    throw refusal(stage, fmt::format("the stiffness of its springs times the squared spacing came "
                                     "out as {:.3g} J, and {:g} J is the most that can be added up",
                                     energy, most_energy));
}

/// Returns an addition to the error about a Poisson ratio that a random body does not reach; empty
/// for other errors.
std::string reach_of_sample(const Body& body, const std::string& sentence) {
  if (body.listed.sample_particles == 0 || !sentence.starts_with("poisson ")) return "";
  const double mean =
      2 * static_cast<double>(body.listed.springs.size()) / static_cast<double>(body.particles);
  if (mean < stiff_coordination)
    return fmt::format(
        ". The body has {:.3g} springs a particle on the mean, too few to be stiff for certain: "
        "expected a coordination of {:g} or more",
        mean, stiff_coordination);
  return ". This reach is the body's own: particles at its surface have fewer springs, so those "
         "inside have more, which lowers the largest Poisson "
         "ratio; a body more spacings across reaches further";
}

/// Adds a criterion of springs or the strength surface. Throws InputError for a second surface.
void add_failure(Material& material, const Stage& stage) {
  const auto& functions = stage.functions<FailureFunctions>();
  if (functions.surface.ratios != nullptr) {
    if (material.surface)
      throw InputError({{stage.pointer, stage.component->type(),
                         fmt::format("one strength surface for each material; {} is one already",
                                     material.surface->stage->component->type())}});
    material.surface.emplace(Material::Surface{&stage, make_component(stage)});
    return;
  }
  Material::Criterion& criterion = material.failures.emplace_back();
  criterion.stage = &stage;
  criterion.component = make_component(stage);
  if (functions.memory > 0)
    call(stage, "start", [&](const Complaint&) {
      functions.start(criterion.start.data());
      return true;
    });
}

Material make_material(const Model& model, const Stage& stage, const LatticeFacts& facts) {
  Material material;
  material.stage = &stage;
  material.component = make_component(stage);
  for (const Stage& failure : stage.failures) add_failure(material, failure);
  const auto refused = refusal_of(stage, "constants", [&](const Complaint& why) {
    return stage.functions<MaterialFunctions>().constants(material.component.get(), facts,
                                                          material.constants, why);
  });
  if (refused)
    throw objection(*model.scene, stage, *refused + reach_of_sample(model.body, *refused));
  check_constants(stage, material.constants, facts.spacing);
  const MaterialConstants& constants = material.constants;
  material.mass = constants.density * facts.site_volume;
  return material;
}

/// Assigns a material to each particle, or to each cell of a body of cells. A later stage overrides
/// earlier ones.
void assign(Model& model, RegionIndex& regions, Faults& faults) {
  const auto has_all = [&](const Material& material) {
    return model.scene->regions[material.stage->region].kind == Region::Kind::all;
  };
  if (model.materials.size() == 1 && has_all(model.materials[0]))
    return;  // not needed, and expensive in a large body
  const bool of_cells = !model.body.cells.empty();
  const char* member = of_cells ? "cell" : "particle";
  std::vector<std::uint8_t> material_of(of_cells ? model.body.cells.count() : model.body.particles,
                                        no_material);
  std::vector<std::uint64_t> count(no_material + std::size_t{1});
  for (std::size_t n = 0; n < model.materials.size(); ++n) {
    const Stage& stage = *model.materials[n].stage;
    if (has_all(model.materials[n])) {
      std::fill(material_of.begin(), material_of.end(), static_cast<std::uint8_t>(n));
      continue;
    }
    bool any = false;
    const auto take = [&](Particle member) {
      any = true;
      material_of[member] = static_cast<std::uint8_t>(n);
    };
    if (of_cells)
      for (const Particle cell : regions.cells(stage.region)) take(cell);
    else
      regions.for_particles(stage.region, take);
    if (!any)
      faults.add(stage.pointer + "/region", "",
                 of_cells ? regions.expected_cells(stage.region)
                          : regions.expected_particles(stage.region));
  }
  if (!faults.empty()) return;
  for (const std::uint8_t material : material_of) ++count[material];
  for (std::size_t n = 0; n < model.materials.size(); ++n)
    if (count[n] == 0)
      faults.add(model.materials[n].stage->pointer + "/region", "",
                 fmt::format("{}s of its own; later materials take all of this one's", member));
  if (count[no_material] > 0) {
    const auto first = static_cast<Particle>(
        std::find(material_of.begin(), material_of.end(), no_material) - material_of.begin());
    const Vec3 at = of_cells ? model.body.centre_of_cell(first) : model.body.position(first);
    faults.add("/pipeline", "",
               fmt::format(
                   "a material for every {}; {} have none, the first at ({:.6g}, {:.6g}, {:.6g}) m",
                   member, count[no_material], at.x, at.y, at.z));
  }
  if (!faults.empty() || model.materials.size() == 1) return;
  if (of_cells)
    model.kinds.mixtures = Mixtures(model.body, material_of, model.materials.size());
  else
    model.kinds.material_of = PagedNumbers<std::uint8_t>(material_of);
}

}  // namespace

void add_materials(Model& model, RegionIndex& regions, Faults& faults) {
  const std::vector<const Stage*> stages = model.scene->of(Family::materials);
  if (stages.empty()) faults.add("/pipeline", "", "a stage that is a material");
  if (stages.size() >= no_material)
    faults.add(stages.back()->pointer, "", fmt::format("at most {} materials", no_material - 1));
  if (!faults.empty()) return;
  const LatticeGeometry geometry = geometry_from(model.body);
  const LatticeFacts facts = facts_of(model, geometry);
  for (const Stage* stage : stages) try {
      model.materials.push_back(make_material(model, *stage, facts));
    } catch (const InputError& error) {
      add_all(faults, error);
    }
  if (!faults.empty()) return;
  std::uint32_t criteria = 0;
  for (Material& material : model.materials)
    for (Material::Criterion& criterion : material.failures) criterion.number = criteria++;
  assign(model, regions, faults);
}

}  // namespace hyperlattice
