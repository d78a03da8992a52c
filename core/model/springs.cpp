// Springs between all pairs of materials, and those of mixtures. A spring between particles of two
// materials consists of two half springs in series. If both have the same linear law without
// constants, these are one spring,
//   k = 2 a b / (a + b),
// and k = 0 if a or b is 0. Stiffnesses of opposite sign, which only some membranes have, are not
// in series; they take the mean. All other pairs are composite springs (composite_spring.hpp). The
// scene may choose the softer or the stiffer material's spring instead.
#include <model/build.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace hyperlattice {

namespace {

using Membrane = KernelChoice::Membrane;

double between(double a, double b) {
  if (a == b) return a;
  if (a == 0 || b == 0) return 0;
  return (a > 0) == (b > 0) ? 2 * a * b / (a + b) : (a + b) / 2;
}

/// Returns the rest length of a class, m; 0 for a listed body, whose springs have all lengths.
double rest_length(const Model& model, std::uint32_t spring_class) {
  const auto of_class = [spring_class](const NeighbourGeometry& n) {
    return n.site.spring_class == spring_class;
  };
  const auto found =
      std::find_if(model.springs.neighbours.begin(), model.springs.neighbours.end(), of_class);
  return found == model.springs.neighbours.end() ? 0 : found->rest_length;
}

/// Returns the kernels of a material's law. Throws OutsideError if they are not whole, and
/// InputError if the law has no kernel for the body.
KernelSet kernels_of(const Material& material, const KernelChoice& choice) {
  const Stage& stage = *material.stage;
  KernelSet kernels;
  call(stage, "kernels", [&](const Complaint& why) {
    return stage.functions<MaterialFunctions>().kernels(material.component.get(), choice, kernels,
                                                        why);
  });
  const bool remembers = kernels.memory > 0;
  if (kernels.ask == nullptr || kernels.take == nullptr || kernels.memory > max_law_memory + 2 ||
      (kernels.start != nullptr && !remembers))
    throw plugin_error(
        stage, "kernels",
        "it lacks the functions of one spring, or its springs keep more numbers than they may");
  if (kernels.step == nullptr || kernels.measure == nullptr || kernels.step_row == nullptr ||
      kernels.measure_row == nullptr) {
    if (choice.precision == Precision::floats)
      throw InputError(
          {{"/precision", "float",
            fmt::format("double; {} has no kernel in floats for {}", stage.component->type(),
                        choice.listed ? "lists of springs" : "this lattice")}});
    throw refusal(stage, choice.listed ? "its law has no kernel for lists of springs"
                                       : "its library has no kernel for this membrane");
  }
  return kernels;
}

/// Returns the material of the springs between two materials; nothing if they have parts of both.
std::optional<std::uint8_t> chosen_material(const Model& model, std::uint8_t a, std::uint8_t b) {
  const InterfaceSprings rule = model.scene->interface_springs;
  if (a == b || rule == InterfaceSprings::series || !model.kinds.mixtures.empty())
    return std::nullopt;
  const auto [first, second] = std::minmax(a, b);
  const bool first_is_softer = model.materials[first].constants.base_stiffness <=
                               model.materials[second].constants.base_stiffness;
  return first_is_softer == (rule == InterfaceSprings::softer) ? first : second;
}

/// Returns the springs of one material, with its own alarm.
SpringConstants spring_within(const Model& model, const Material& material,
                              std::uint32_t spring_class) {
  const MaterialConstants& own = material.constants;
  SpringConstants spring;
  spring.stiffness = model.body.grid.class_stiffness[spring_class] * own.base_stiffness;
  spring.cross_stiffness = own.cross_ratio[spring_class] * own.base_stiffness;
  const SpringFacts facts{rest_length(model, spring_class), spring.stiffness,
                          model.body.grid.spacing, spring_class, model.springs.crossings};
  spring.alarm = material.alarm(facts);
  if (!model.cohesive.empty()) {
    const auto number = static_cast<std::size_t>(&material - model.materials.data());
    const Cohesive& of = model.cohesive[number];
    if (of.stage != nullptr)
      spring.alarm = std::min(spring.alarm, of.stretch_alarm * facts.rest_length);
  }
  for (int cross = 0; cross < 2; ++cross)
    std::copy_n(own.law[spring_class][cross], max_law_constants, spring.law[cross]);
  return spring;
}

/// Returns the spring between two materials: of linear laws itself, of others its stiffness near
/// rest. Each material's alarm is that of the same force in a spring of its own.
SpringConstants spring_between(const Model& model, std::uint8_t a, std::uint8_t b,
                               std::uint32_t spring_class) {
  if (a == b) return spring_within(model, model.materials[a], spring_class);
  const SpringConstants left = spring_within(model, model.materials[a], spring_class),
                        right = spring_within(model, model.materials[b], spring_class);
  if (const auto chosen = chosen_material(model, a, b)) return *chosen == a ? left : right;
  SpringConstants spring;
  spring.stiffness = between(left.stiffness, right.stiffness);
  spring.cross_stiffness = between(left.cross_stiffness, right.cross_stiffness);
  for (const SpringConstants* own : {&left, &right})
    spring.alarm = std::min(spring.alarm, own->alarm * (own->stiffness / spring.stiffness));
  return spring;
}

/// Returns whether one spring of the kernels describes the springs between these materials.
bool is_one_spring(const Model& model, std::uint8_t a, std::uint8_t b) {
  return a == b || (model.materials[a].law == model.materials[b].law &&
                    model.springs.laws[model.materials[a].law].kernels.linear);
}

/// Makes the parts of the springs between two materials whose laws or constants differ.
void join(Model& model, std::uint8_t a, std::uint8_t b, std::uint32_t spring_class) {
  const auto [first, second] = std::minmax(a, b);
  std::vector<SpringPart> parts;
  auto joined = CompositeSpring::Joined::side_by_side;
  if (const auto chosen = chosen_material(model, a, b)) {
    parts = {part_of(model, *chosen, spring_class, 1)};
  } else {
    parts = {part_of(model, first, spring_class, 0.5), part_of(model, second, spring_class, 0.5)};
    joined = CompositeSpring::Joined::in_series;
  }
  model.springs.add_composite(model.springs.spring_index(a, b, spring_class),
                              CompositeSpring(model.springs.laws, std::move(parts), joined));
}

/// Makes the springs between all pairs of materials.
void add_springs(Model& model) {
  const auto materials = static_cast<std::uint8_t>(model.materials.size());
  const std::uint32_t classes = model.body.grid.spring_classes;
  for (std::uint8_t a = 0; a < materials; ++a)
    for (std::uint8_t b = 0; b < materials; ++b)
      for (std::uint32_t c = 0; c < classes; ++c)
        model.springs.constants.push_back(spring_between(model, a, b, c));
  for (std::uint8_t a = 0; a < materials && model.kinds.mixtures.empty(); ++a)
    for (std::uint8_t b = 0; b < materials; ++b)
      for (std::uint32_t c = 0; c < classes && !is_one_spring(model, a, b); ++c)
        join(model, a, b, c);
}

/// Finds the body's laws and their kernels.
void find_laws(Model& model) {
  SpringTable& springs = model.springs;
  for (Material& material : model.materials) {
    const Stage& stage = *material.stage;
    const std::string_view name =
        stage.functions<MaterialFunctions>().law(material.component.get());
    const auto has_law = [&](const Law& law) {
      return law.stage->component->path == stage.component->path && law.name == name;
    };
    const auto found = std::find_if(springs.laws.begin(), springs.laws.end(), has_law);
    material.law = static_cast<std::uint32_t>(found - springs.laws.begin());
    const bool is_new = found == springs.laws.end();
    if (is_new) springs.laws.push_back({&stage, name, kernels_of(material, springs.choice)});
    KernelSet& kernels = springs.laws[material.law].kernels;
    if (const std::size_t declared = stage.component->info.fields.size();
        declared != kernels.fields || (kernels.fields > 0 && kernels.read_fields == nullptr))
      throw plugin_error(
          stage, "kernels",
          fmt::format("its law gives {} fields, and it declares {}", kernels.fields, declared));
    if (!is_new) continue;
    springs.memory = std::max(springs.memory, kernels.memory);
    springs.softens = springs.softens || kernels.softens;
    KernelChoice row = springs.choice;  // linearise takes listed springs as rows of one spring
    row.listed = false;
    if (springs.choice.listed) kernels.linearise = kernels_of(material, row).linearise;
  }
}

/// Returns the number of springs through a unit of area, 1/m2. A spring crosses a plane that is
/// nearer than the spring's component along the normal, in the mean of all directions L / 2.
double crossings(const Model& model) {
  double length = 0;  // total length of the springs of one particle
  for (const NeighbourGeometry& neighbour : model.springs.neighbours)
    length += neighbour.rest_length;
  const Listed& listed = model.body.listed;
  for (const ListedSpring& spring : listed.springs)
    length += norm(listed.positions[spring.b] - listed.positions[spring.a]) /
              static_cast<double>(model.body.particles);
  return length / (2 * model.body.grid.site_volume);
}

/// Returns the membrane of the body: free if one material's membrane is free. Adds a fault if
/// another one is clamped.
/// Refuses an alpha spring that alone pushes the heights away. The analysis of waves does not see
/// it, because a body without cross springs has no heights.
void check_alpha_alone(const Material& material, Faults& faults) {
  if (material.constants.has_cross_springs() || material.constants.alpha_ratio >= 0) return;
  faults.add(material.stage->pointer, material.stage->component->type(),
             "springs that make a stable lattice, or allow_unstable in the scene; with a negative "
             "k_alpha alone every height grows");
}

Membrane membrane_of(const std::vector<Material>& materials, Faults& faults) {
  const Material *clamped = nullptr, *free = nullptr;
  for (const Material& material : materials)
    if (material.constants.has_cross_springs())
      (material.constants.clamped ? clamped : free) = &material;
  if (clamped != nullptr && free != nullptr)
    faults.add(clamped->stage->pointer, clamped->stage->component->type(),
               fmt::format("a membrane that can move in the fourth dimension, as that of {}: "
                           "clamped and free ones cannot stand in one body",
                           free->stage->pointer));
  return free != nullptr ? Membrane::free : clamped != nullptr ? Membrane::clamped : Membrane::none;
}

/// In a body with a free membrane, a material without one still has heights, and no spring would
/// hold them. An alpha spring as stiff as the sum of the base springs along an axis holds them at
/// rest; it changes neither the elasticity nor the time step of the body.
void hold_heights(Model& model) {
  for (Material& material : model.materials) {
    if (material.constants.has_cross_springs()) continue;
    double ratio = 0;
    for (const NeighbourGeometry& n : model.springs.neighbours)
      ratio += 2 * model.body.grid.class_stiffness[n.site.spring_class] * n.rest.x * n.rest.x /
               (n.rest_length * n.rest_length);
    if (model.body.is_listed())  // for a particle with the mean number of springs
      ratio = 2 * static_cast<double>(model.body.listed.springs.size()) /
              static_cast<double>(model.body.particles) / 3;
    material.constants.alpha_ratio = std::max(material.constants.alpha_ratio, ratio);
  }
}

}  // namespace

SpringPart part_of(const Model& model, std::uint8_t material, std::uint32_t spring_class,
                   double weight) {
  const Material& of = model.materials[material];
  const SpringConstants& own = model.springs.spring(material, material, spring_class);
  return {material,
          of.law,
          weight,
          {own.stiffness, own.cross_stiffness},
          {of.constants.law[spring_class][0], of.constants.law[spring_class][1]}};
}

SpringProperties Model::spring_properties(Particle a, Particle b, std::uint32_t neighbour) const {
  SpringProperties properties;
  double stiffness = 1;
  if (body.is_listed()) {
    properties.rest = body.listed.positions[b] - body.listed.positions[a];
    properties.rest_length = norm(properties.rest);
    properties.cross_rest_length = std::hypot(properties.rest_length, body.grid.membrane_distance);
    stiffness = body.listed.springs[neighbour].stiffness;
  } else {
    const NeighbourGeometry& to = springs.neighbours[neighbour];
    properties.rest = to.rest;
    properties.rest_length = to.rest_length;
    properties.cross_rest_length = to.cross_rest_length;
    properties.spring_class = to.site.spring_class;
    if (!body.cells.empty()) properties.share = body.share(body.site(a), to.site);
  }
  const SpringConstants& constants = body.is_listed()
                                         ? springs.spring(kinds.material(a), kinds.material(b), 0)
                                         : springs.spring_to(neighbour, kinds.of(a), kinds.of(b));
  properties.stiffness = stiffness * constants.stiffness;
  properties.cross_stiffness = stiffness * constants.cross_stiffness;
  properties.law =
      materials[kinds.mixtures.empty() ? kinds.material(a)
                                       : kinds.mixtures.material_of_spring(
                                             kinds.of(a), springs.neighbours[neighbour].site)]
          .law;
  properties.composite = springs.composite(constants);
  properties.factor = stiffness;
  for (const std::size_t cross : {0U, 1U}) properties.constants[cross] = constants.law[cross];
  return properties;
}

SpringMaterials Model::materials_of(Particle a, Particle b, std::uint32_t neighbour) const {
  SpringMaterials found;
  if (const auto chosen = chosen_material(*this, kinds.material(a), kinds.material(b))) {
    found.add(*chosen);
  } else if (!kinds.mixtures.empty()) {
    kinds.mixtures.for_cells(kinds.mixtures.of(a), body.neighbours[neighbour],
                             [&](std::uint8_t material, double) { found.add(material); });
  } else {
    found.add(kinds.material(a));
    found.add(kinds.material(b));
  }
  return found;
}

double Model::elongation_in(std::uint8_t material, const SpringProperties& properties,
                            double elongation, const double* kept) const {
  if (properties.composite != nullptr) {
    const auto parts = properties.composite->parts();
    for (std::size_t n = 0; n < parts.size(); ++n)
      if (parts[n].material == material)
        return properties.composite->elongation_of(n, elongation, kept);
  }
  if (!kinds.mixtures.empty()) return elongation;
  return elongation * (properties.stiffness / facts(properties, material).stiffness);
}

double Model::own_alarm(std::uint8_t material, const SpringProperties& properties) const {
  if (body.is_listed()) return materials[material].alarm(facts(properties, material));
  return springs.spring(material, material, properties.spring_class).alarm;
}

double Model::alarm(Particle a, Particle b, std::uint32_t neighbour,
                    const SpringProperties& properties) const {
  double lowest = infinity;
  for (const std::uint8_t material : materials_of(a, b, neighbour)) {
    const double scale =
        kinds.mixtures.empty() ? facts(properties, material).stiffness / properties.stiffness : 1;
    lowest = std::min(lowest, own_alarm(material, properties) * scale);
  }
  return lowest;
}

void set_springs(Model& model, Faults& faults) {
  SpringTable& springs = model.springs;
  springs.materials = model.materials.size();
  springs.spring_classes = model.body.grid.spring_classes;
  springs.neighbours = geometry_of(model.body.grid);
  springs.crossings = crossings(model);
  springs.choice.membrane = membrane_of(model.materials, faults);
  if (!model.scene->allow_unstable)
    for (const Material& material : model.materials) check_alpha_alone(material, faults);
  if (springs.choice.membrane == Membrane::free) hold_heights(model);
  model.degrees_of_freedom = springs.choice.membrane == Membrane::free ? 4 : 3;
  springs.choice.listed = model.body.is_listed();
  springs.choice.precision = model.scene->precision;
  for (const Material& material : model.materials)
    for (const Material::Criterion& criterion : material.failures) {
      springs.criteria = true;
      if (!criterion.stage->functions<FailureFunctions>().asks_rate) continue;
      springs.asks_rate = true;
    }
  find_laws(model);
  set_cohesive(model, faults);
  springs.breakable = springs.criteria || !model.cohesive.empty();
  add_springs(model);
  for (const Material& material : model.materials) {
    const MaterialConstants& constants = material.constants;
    model.kinds.masses.push_back(material.mass);
    model.kinds.alphas.push_back(
        constants.clamped ? 0 : constants.alpha_ratio * constants.base_stiffness);
  }
  if (!model.kinds.mixtures.empty()) add_mixtures(model);
  if (!springs.composites.empty() && springs.choice.precision == Precision::floats)
    faults.add("/precision", "float",
               "double: springs between materials with different laws, or different constants of "
               "a law, are computed in doubles");
}

}  // namespace hyperlattice
