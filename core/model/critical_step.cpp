#include <model/critical_step.hpp>
#include <model/stability.hpp>
#include <scene/stage_call.hpp>

#include <spdlog/fmt/fmt.h>

#include <array>
#include <map>

namespace hyperlattice {

namespace {

InfiniteLattice lattice_of(const Model& model, std::size_t material) {
  const std::size_t classes = model.body.grid.spring_classes;
  const MaterialConstants& constants = model.materials[material].constants;
  return {model.springs.neighbours,
          std::span(model.springs.constants)
              .subspan((material * model.materials.size() + material) * classes, classes),
          constants.alpha_ratio * constants.base_stiffness,
          model.body.grid.membrane_distance,
          model.springs.choice.membrane,
          model.body.grid.spacing,
          model.body.grid.basis,
          constants.volumetric};
}

/// The material of a particle and those of its neighbours on both sides. Absent neighbours count as
/// neighbours of the same material, which is on the safe side.
using Environment = std::array<std::uint8_t, 1 + 2 * max_neighbours>;

Environment uniform(std::uint8_t material) {
  Environment all;
  all.fill(material);
  return all;
}

double bound(const Model& model, const Environment& environment) {
  const std::uint8_t own = environment[0];
  const MaterialConstants& constants = model.materials[own].constants;
  StiffnessBound sum;
  for (std::size_t n = 0; n < model.springs.neighbours.size(); ++n)
    for (const int side : {1, -1}) {
      const NeighbourGeometry& neighbour = model.springs.neighbours[n];
      const std::uint8_t other = environment[1 + 2 * n + (side < 0 ? 1 : 0)];
      sum.add(neighbour, side, model.springs.spring(own, other, neighbour.site.spring_class),
              model.body.grid.membrane_distance, model.springs.choice.membrane);
    }
  if (model.springs.choice.membrane == KernelChoice::Membrane::free)
    sum.add_alpha(constants.alpha_ratio * constants.base_stiffness);
  return sum.value();
}

/// Returns a bound of m omega^2, N/m, for the volumetric energies of all cells: that of the
/// stiffest wave of an infinite lattice of such cells. A body lacks some of them, which only
/// softens it.
double volumetric_bound(const Model& model) {
  return 4 * std::max(0.0, model.volumetric.largest()) * model.body.grid.spacing;
}

/// Returns every environment that occurs, each with one particle that has it. Most particles have
/// neighbours of their own material only; these have one entry for each material, without a
/// particle.
std::map<Environment, Particle> environments(const Model& model) {
  std::map<Environment, Particle> found;
  for (std::size_t material = 0; material < model.materials.size(); ++material)
    found.emplace(uniform(static_cast<std::uint8_t>(material)), Body::no_particle);
  for (const Run& run : model.body.runs)
    for (std::int32_t i = run.begin; i < run.end; ++i) {
      const Particle particle = run.first + static_cast<Particle>(i - run.begin);
      Environment here = uniform(model.kinds.material_of[particle]);
      bool mixed = false;
      for (std::size_t n = 0; n < model.springs.neighbours.size(); ++n)
        for (const int side : {1, -1}) {
          const Neighbour& step = model.springs.neighbours[n].site;
          const Particle other =
              model.body.at({i + side * step.dx, run.j + side * step.dy, run.k + side * step.dz});
          if (other == Body::no_particle || model.kinds.material_of[other] == here[0]) continue;
          here[1 + 2 * n + (side < 0 ? 1 : 0)] = model.kinds.material_of[other];
          mixed = true;
        }
      if (mixed) found.emplace(here, particle);
    }
  return found;
}

double step_of(double stiffness, double mass) { return 2 / std::sqrt(stiffness / mass); }

/// Takes the frequency found by iteration in place of the bound that the step has.
void limit_step_by_iteration(Model& model, double (*frequency)(const Model&)) {
  const double step = 2 / frequency(model);
  if (!(step > model.step_limit.time_step)) return;
  model.step_limit.time_step = step;
  model.step_limit.because =
      "the stiffest motion of the body, found by iteration and increased by 2 %";
}

/// Sets the critical step of a listed body. A list has no plane waves, so the springs of each
/// particle give a bound.
void find_critical_step_of_list(Model& model, Faults& faults) {
  const ListedBound bound = listed_bound(model);
  const Stage& stage = *model.materials.front().stage;
  if (!bound.all_positive && !model.scene->allow_unstable)
    return faults.add(stage.pointer, stage.component->type(),
                      "springs of positive stiffness, or allow_unstable in the scene: a listed "
                      "lattice with negative ones is not known to be stable");
  if (!bound.all_positive)
    model.warnings.emplace_back(
        "a listed lattice with springs of negative stiffness is not known to be stable");
  if (!(bound.square > 0))
    return faults.add("/pipeline", "",
                      "a lattice with springs; this one's particles are all alone");
  const Vec3 at = model.body.position(bound.particle);
  model.step_limit.time_step = 2 / std::sqrt(bound.square);
  model.step_limit.because = fmt::format(
      "a safe bound for a listed lattice: the springs of the particle at ({:.4g}, {:.4g}, {:.4g}) "
      "m",
      at.x, at.y, at.z);
  constexpr std::uint64_t most = 200000;  // particles
  if (model.nodal_volumes && model.body.particles <= most &&
      model.springs.choice.membrane == KernelChoice::Membrane::none)
    limit_step_by_iteration(model, iterated_frequency_of_list);
  for (Material& material : model.materials)
    material.critical_time_step = model.step_limit.time_step;
}

bool has_negative_springs(const InfiniteLattice& lattice) {
  return std::any_of(lattice.springs.begin(), lattice.springs.end(),
                     [](const SpringConstants& spring) { return spring.cross_stiffness < 0; });
}

/// Sets the critical step of one material alone. Waves that grow do not limit the step. If all
/// waves grow, a bound with the absolute stiffnesses replaces them. A negative volumetric energy
/// lowers every frequency; at the surface of a body it is missing, so it counts as zero.
void limit_step(Model& model, std::size_t n, InfiniteLattice lattice, bool unstable) {
  Material& material = model.materials[n];
  lattice.volumetric = std::max(0.0, lattice.volumetric);
  const Wave wave = stiffest_wave(lattice);
  const char* which = unstable ? "the stiffest of all waves of the lattice that do not grow: "
                               : "the stiffest of all waves of the lattice: ";
  model.step_limit.because = which + describe(wave);
  double stiffness = wave.stiffness;
  if (stiffness <= 0) {
    stiffness = bound(model, uniform(static_cast<std::uint8_t>(n)));
    model.step_limit.because = "a safe bound: every wave of the lattice grows";
  }
  model.step_limit.time_step = material.critical_time_step = step_of(stiffness, material.mass);
}

/// Returns the stable step, s, that the law of a material leaves of `elastic`, s.
double stable_step_of_law(const Material& material, double elastic) {
  const auto stable_step = material.stage->functions<MaterialFunctions>().stable_step;
  if (stable_step == nullptr) return elastic;
  double step = 0;
  call(*material.stage, "stable_time_step", [&](const Complaint& why) {
    return stable_step(material.component.get(), elastic, step, why);
  });
  if (!(step > 0))
    throw plugin_error(*material.stage, "stable_time_step",
                       fmt::format("it gives a time step of {} s", step));
  return step;
}

/// Shortens the critical step to the stable step of laws that are not purely elastic.
void limit_by_laws(Model& model) {
  const double elastic = model.step_limit.time_step;
  for (const Material& material : model.materials) {
    const double step = stable_step_of_law(material, elastic);
    if (!(step < model.step_limit.time_step)) continue;
    model.step_limit.time_step = step;
    model.step_limit.because +=
        fmt::format("; of its {:.4g} s the law of {} ({}) leaves {:.4g} s", elastic,
                    material.stage->name, material.stage->pointer, step);
  }
}

/// Sets the critical step of a body of cells. The bound by one cell is up to 1.5 times too careful
/// for a body with volumetric energies; where iteration costs little it replaces the bound.
void limit_step_of_cells(Model& model) {
  constexpr std::uint64_t most_cells = 500000;
  const double bound = 2 / std::sqrt(cell_bound(model));
  model.step_limit.time_step = bound;
  model.step_limit.because =
      "a safe bound for a body of cells: the stiffest motion of a cell that moves alone";
  if (!(model.volumetric.largest() > 0) || model.body.cells.count() > most_cells) return;
  limit_step_by_iteration(model, iterated_frequency);
}

void find_elastic_step(Model& model, Faults& faults) {
  if (model.body.is_listed()) return find_critical_step_of_list(model, faults);
  const std::size_t before = faults.size();
  for (std::size_t n = 0; n < model.materials.size(); ++n) {
    const Material& material = model.materials[n];
    const InfiniteLattice lattice = lattice_of(model, n);
    const auto unstable = find_instability(lattice, Sector::mirrored);
    if (unstable && !model.scene->allow_unstable) {
      faults.add(
          material.stage->pointer, material.stage->component->type(),
          "springs that make a stable lattice, or allow_unstable in the scene; with these, " +
              describe(*unstable));
      continue;
    }
    if (unstable)
      model.warnings.push_back(fmt::format("the lattice of {} ({}) is unstable: {}",
                                           material.stage->name, material.stage->pointer,
                                           describe(*unstable)));
    else if (model.step_limit.two_layers_grow.empty() && has_negative_springs(lattice))
      if (const auto opposed = find_instability(lattice, Sector::opposed))
        model.step_limit.two_layers_grow = describe(*opposed);
    limit_step(model, n, lattice, unstable.has_value());
  }
  if (faults.size() > before) return;
  if (!model.body.cells.empty()) return limit_step_of_cells(model);
  if (model.materials.size() == 1) return;

  model.step_limit.time_step = infinity;
  for (const auto& [environment, particle] : environments(model)) {
    const Material& own = model.materials[environment[0]];
    const double step = step_of(bound(model, environment) + volumetric_bound(model), own.mass);
    if (step >= model.step_limit.time_step) continue;
    model.step_limit.time_step = step;
    const std::string where = particle == Body::no_particle ? "inside" : "at the border of";
    model.step_limit.because =
        fmt::format("a safe bound for several materials: the springs of a particle {} {} ({})",
                    where, own.stage->name, own.stage->pointer);
  }
}

}  // namespace

double stable_step_of_laws(const Model& model, double elastic) {
  double step = elastic;
  for (const Material& material : model.materials)
    step = std::min(step, stable_step_of_law(material, elastic));
  return step;
}

void find_critical_step(Model& model, Faults& faults) {
  const std::size_t before = faults.size();
  find_elastic_step(model, faults);
  if (faults.size() == before) limit_by_laws(model);
}

}  // namespace hyperlattice
