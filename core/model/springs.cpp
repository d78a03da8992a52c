// Springs between all pairs of materials, and those of mixtures. A spring between particles of two
// materials consists of two half springs in series,
//   k = 2 a b / (a + b),
// and k = 0 if a or b is 0. The constants of the law are the mean of both. (Stiffnesses of opposite
// sign, which only some membranes have, are not in series; they take the mean.)
#include <model/build.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

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
  const auto found = std::find_if(model.neighbours.begin(), model.neighbours.end(), of_class);
  return found == model.neighbours.end() ? 0 : found->rest_length;
}

KernelSet kernels_of(const Stage& stage, const KernelChoice& choice) {
  KernelSet kernels;
  call(stage, "kernels", [&](const Complaint& why) {
    return stage.functions<MaterialFunctions>().kernels(choice, kernels, why);
  });
  const bool remembers = kernels.memory > 0;
  if (kernels.ask == nullptr || kernels.take == nullptr || kernels.memory > max_law_memory + 2 ||
      (kernels.start != nullptr && !remembers))
    throw plugin_error(
        stage, "kernels",
        "it lacks the functions of one spring, or its springs keep more numbers than they may");
  return kernels;
}

SpringConstants spring_between(const Model& model, const Material& a, const Material& b,
                               std::uint32_t spring_class) {
  const MaterialConstants &left = a.constants, &right = b.constants;
  SpringConstants spring;
  spring.stiffness = model.body.grid.class_stiffness[spring_class] *
                     between(left.base_stiffness, right.base_stiffness);
  spring.cross_stiffness = between(left.cross_ratio[spring_class] * left.base_stiffness,
                                   right.cross_ratio[spring_class] * right.base_stiffness);
  const SpringFacts facts{rest_length(model, spring_class), spring.stiffness,
                          model.body.grid.spacing, spring_class, model.crossings};
  spring.alarm = std::min(a.alarm(facts), b.alarm(facts));
  for (int cross = 0; cross < 2; ++cross)
    for (std::size_t n = 0; n < max_law_constants; ++n)
      spring.law[cross][n] =
          0.5 * (left.law[spring_class][cross][n] + right.law[spring_class][cross][n]);
  return spring;
}

/// Returns the number of springs through a unit of area, 1/m2. A spring crosses a plane that is
/// nearer than the spring's component along the normal, in the mean of all directions L / 2.
double crossings(const Model& model) {
  double length = 0;  // total length of the springs of one particle
  for (const NeighbourGeometry& neighbour : model.neighbours) length += neighbour.rest_length;
  const Listed& listed = model.body.listed;
  for (const ListedSpring& spring : listed.springs)
    length += norm(listed.positions[spring.b] - listed.positions[spring.a]) /
              static_cast<double>(model.body.particles);
  return length / (2 * model.body.grid.site_volume);
}

/// Returns the membrane of the body: free if one material's membrane is free. Adds a fault if
/// another one is clamped.
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
    for (const NeighbourGeometry& n : model.neighbours)
      ratio += 2 * model.body.grid.class_stiffness[n.site.spring_class] * n.rest.x * n.rest.x /
               (n.rest_length * n.rest_length);
    if (model.body.is_listed())  // for a particle with the mean number of springs
      ratio = 2 * static_cast<double>(model.body.listed.springs.size()) /
              static_cast<double>(model.body.particles) / 3;
    material.constants.alpha_ratio = std::max(material.constants.alpha_ratio, ratio);
  }
}

}  // namespace

double Material::Criterion::alarm(const SpringFacts& spring) const {
  double alarm = 0;
  call(*stage, "alarm", [&](const Complaint& why) {
    return stage->functions<FailureFunctions>().alarm(component.get(), spring, alarm, why);
  });
  // Such a spring would never break, and nobody would notice.
  if (std::isnan(alarm))
    throw plugin_error(*stage, "alarm", "it gives an elongation that is no number (nan)");
  return std::max(alarm,
                  -spring.rest_length);  // no length is negative, so no elongation is below -L0
}

double Material::alarm(const SpringFacts& spring) const {
  double lowest = infinity;
  for (const Criterion& criterion : failures) lowest = std::min(lowest, criterion.alarm(spring));
  return lowest;
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
    const NeighbourGeometry& to = neighbours[neighbour];
    properties.rest = to.rest;
    properties.rest_length = to.rest_length;
    properties.cross_rest_length = to.cross_rest_length;
    properties.spring_class = to.site.spring_class;
    if (!body.cells.empty()) properties.share = body.share(body.site(a), to.site);
  }
  const SpringConstants& constants = body.is_listed() ? spring(material(a), material(b), 0)
                                                      : spring_to(neighbour, kind(a), kind(b));
  properties.stiffness = stiffness * constants.stiffness;
  properties.cross_stiffness = stiffness * constants.cross_stiffness;
  properties.law = constants.law[0];
  properties.cross_law = constants.law[1];
  return properties;
}

SpringMaterials Model::materials_of(Particle a, Particle b, std::uint32_t neighbour) const {
  SpringMaterials found;
  if (!mixtures.empty()) {
    mixtures.for_cells(mixtures.of(a), body.neighbours[neighbour],
                       [&](std::uint8_t material) { found.add(material); });
  } else {
    found.add(material(a));
    found.add(material(b));
  }
  return found;
}

double Model::alarm(Particle a, Particle b, std::uint32_t neighbour,
                    const SpringProperties& properties) const {
  double lowest = infinity;
  for (const std::uint8_t material : materials_of(a, b, neighbour))
    lowest = std::min(lowest, materials[material].alarm(facts(properties, material)));
  return lowest;
}

std::vector<NeighbourGeometry> geometry_of(const Grid& grid) {
  std::vector<NeighbourGeometry> all;
  for (const Neighbour& n : grid.neighbours) {
    const Vec3 rest = grid.spacing * combined(grid.basis, n.dx, n.dy, n.dz);
    all.push_back({n, rest, norm(rest), std::hypot(norm(rest), grid.membrane_distance)});
  }
  return all;
}

void set_springs(Model& model, Faults& faults) {
  model.neighbours = geometry_of(model.body.grid);
  model.crossings = crossings(model);
  model.choice.membrane = membrane_of(model.materials, faults);
  if (model.choice.membrane == Membrane::free) hold_heights(model);
  model.degrees_of_freedom = model.choice.membrane == Membrane::free ? 4 : 3;
  model.choice.mixed = model.materials.size() > 1;
  model.choice.listed = model.body.is_listed();
  model.choice.precision = model.scene->precision;
  for (const Material& material : model.materials)
    for (const Material::Criterion& criterion : material.failures) {
      model.choice.breakable = true;
      if (!criterion.stage->functions<FailureFunctions>().asks_rate) continue;
      model.asks_rate = true;
      if (model.body.is_listed())
        faults.add(criterion.stage->pointer, criterion.stage->component->type(),
                   "a criterion that does not ask for the rate, for a listed lattice");
    }
  model.kernels = kernels_of(*model.materials[0].stage, model.choice);
  KernelChoice row = model.choice;  // linearise takes listed springs as rows of one spring
  row.listed = false;
  if (model.choice.listed)
    model.kernels.linearise = kernels_of(*model.materials[0].stage, row).linearise;
  if (model.kernels.step == nullptr || model.kernels.step_damped == nullptr ||
      model.kernels.measure == nullptr) {
    if (model.choice.precision == Precision::floats)
      throw InputError({{"/precision", "float",
                         fmt::format("double; {} has no kernel in floats for {}",
                                     model.materials[0].stage->component->type(),
                                     model.choice.listed ? "lists of springs" : "this lattice")}});
    throw refusal(*model.materials[0].stage, model.choice.listed
                                                 ? "its law has no kernel for lists of springs"
                                                 : "its library has no kernel for this membrane");
  }

  for (const Material& a : model.materials)
    for (const Material& b : model.materials)
      for (std::uint32_t c = 0; c < model.body.grid.spring_classes; ++c)
        model.springs.push_back(spring_between(model, a, b, c));
  for (const Material& material : model.materials) {
    const MaterialConstants& constants = material.constants;
    model.masses.push_back(material.mass);
    model.alphas.push_back(constants.clamped ? 0
                                             : constants.alpha_ratio * constants.base_stiffness);
  }
  if (!model.mixtures.empty()) add_mixtures(model);
}

}  // namespace hyperlattice
