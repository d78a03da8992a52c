// The contract of laws: the force is the derivative of the energy, dissipation is never negative,
// forces rotate with the body, and the kernels of the law keep the energy balance and give the same
// bits with any number of threads.
#include <contract/families.hpp>
#include <contract/lone_spring.hpp>
#include <model/law.hpp>

#include <hyperlattice/files.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

namespace hyperlattice::contract {
namespace {

double largest_force(const std::vector<PathPoint>& path) {
  std::vector<double> forces(path.size());
  std::transform(path.begin(), path.end(), forces.begin(),
                 [](const PathPoint& point) { return point.force; });
  return largest(forces);
}

/// Compares the force with differences of the energy, at constant memory and zero rate.
Finding force_from_energy(const LoneSpring& lone) {
  LoneSpring spring = lone;
  const double reach = spring.reach(), h = 1e-4 * reach, time_step = spring.period() / 10;
  const std::vector<double> path = path_through(usual_turns(reach), reach / 100);
  double worst = 0, at = 0, force_there = 0, slope_there = 0, scale = 0;
  for (std::size_t n = 0; n < path.size(); ++n) {
    spring.move(path[n], n == 0 ? 0 : time_step);
    if (n % 10 != 5) continue;
    LoneSpring held = spring;
    const double force = held.move(path[n], time_step).force,
                 slope = (held.energy(path[n] + h) - held.energy(path[n] - h)) / (2 * h);
    take_largest(scale, force);
    if (const double error = force - slope; !(std::abs(error) <= worst)) {
      take_largest(worst, error);
      at = path[n];
      force_there = force;
      slope_there = slope;
    }
  }
  return passes_if(
      scale > 0 && std::isfinite(scale) && worst <= 1e-4 * scale,
      fmt::format("largest difference {:.1e} of the largest force; at an elongation of {:.3g} m "
                  "the force is {:.4g} N, the slope of the energy {:.4g} N",
                  worst / scale, at, force_there, slope_there));
}

/// Checks that dissipation is never negative. The tolerance: where the rate changes its sign and
/// the force lags, the work of a step has an error of second order in the step.
Finding dissipates(const LoneSpring& spring) {
  constexpr double allowed = 1e-3;
  double gained = 0, spent = 0, scale = 0;
  const auto add = [&](const std::vector<PathPoint>& path) {
    for (std::size_t n = 1; n < path.size(); ++n) {
      const double dissipated = path[n].dissipated(path[n - 1]);
      (dissipated >= 0 ? spent : gained) +=
          std::abs(dissipated);  // NaN counts as gained, so that it fails
      scale += std::abs(path[n].work);
    }
  };
  add(usual_path(spring));
  for (const std::uint64_t seed : {1U, 2U, 3U}) add(random_path(spring, seed));
  return passes_if(scale > 0 && gained <= allowed * scale,
                   fmt::format("loaded, unloaded, compressed and at random: {:.3g} of the work is "
                               "dissipated, {:.1e} of it given back out of nothing",
                               spent / scale, gained / scale));
}

/// Checks the tangent that static solvers use: `axial` and `pull` of a row of one spring, see
/// kernels/tangent.hpp. The memory is that of a new spring.
Finding tangent(const Model& model, const LoneSpring& lone) {
  const NeighbourGeometry& neighbour = model.springs.neighbours.front();
  const double length = neighbour.rest_length;
  const auto linearised = [&](double elongation) {
    constexpr int padded = lanes_of<float>;
    double zero[padded] = {}, there[padded] = {}, one[padded] = {1}, stiffness[padded] = {},
           cross[padded] = {}, results[4][padded] = {};
    there[0] = elongation;
    std::fill_n(stiffness, padded,
                model.springs.spring(0, 0, neighbour.site.spring_class).stiffness);
    SpringRow row;
    row.count = 1;
    for (int c = 0; c < 4; ++c) {
      row.here[c] = zero;
      row.there[c] = c == 0 ? there : zero;
    }
    row.stiffness = stiffness;
    row.cross_stiffness = cross;
    const SpringConstants& constants = model.springs.spring(0, 0, neighbour.site.spring_class);
    for (std::size_t kind = 0; kind < 2; ++kind) {
      row.law[kind] = constants.law[kind];
      row.memory[kind] = lone.memory().data();
    }
    row.memory_stride = 1;
    row.weight = one;
    row.rest = {length, 0, 0};
    row.rest_length = row.cross_rest_length = row.spacing = length;
    row.membrane_distance = model.body.grid.membrane_distance;
    row.pull = results[0];
    row.axial = results[1];
    row.cross_pull = results[2];
    row.cross_axial = results[3];
    linearise_springs(model.springs.laws.front(), row);
    const double now = length + elongation;
    struct Answer {
      double force, slope;
    };
    return Answer{results[0][0] * now,
                  results[1][0] * now * now / (length * length) + results[0][0]};
  };
  const double reach = lone.reach(), h = 1e-4 * reach;
  const double stiffness = linearised(0).slope;
  double worst = 0, largest_force = 0;
  for (const double share : {-0.5, 0.1, 0.6, 1.7, 2.5}) {
    const double u = share * reach,
                 slope = (linearised(u + h).force - linearised(u - h).force) / (2 * h),
                 force = LoneSpring(lone).move(u, 0).force;
    take_largest(largest_force, force);
    take_largest(worst, (linearised(u).slope - slope) / stiffness);
    take_largest(worst, (linearised(u).force - force) / largest_force);
  }
  return passes_if(worst < 1e-5,
                   fmt::format("against differences of the force, over the stiffness at rest, and "
                               "the force against the law: {:.1e}",
                               worst));
}

/// Compares the forces of a body of two particles and one spring on the usual path with those of
/// the spring alone.
Finding kernels_follow_the_law(const Model& model, const LoneSpring& spring, double allowed) {
  if (model.springs.choice.membrane != KernelChoice::Membrane::none)
    return not_applicable(
        "the example has springs in the fourth dimension beside each base spring");
  std::vector<double> elongations = path_through(usual_turns(spring.reach()), spring.reach() / 100);
  for (double& elongation : elongations)
    elongation = double{static_cast<float>(elongation)};  // the same in every precision
  const std::vector<PathPoint> path = follow(spring, elongations, spring.period() / 10);
  DrivenBody pair(model);
  double worst = 0;
  for (std::size_t n = 0; n < path.size(); ++n) {
    const std::vector<double> forces =
        pair.forces({0, 0, 0, path[n].elongation, 0, 0}, spring.period() / 10);
    for (const double error : {forces[0] - path[n].force, forces[3] + path[n].force})
      take_largest(worst, error);
  }
  return passes_if(std::isfinite(worst) && worst <= allowed * largest_force(path),
                   fmt::format("two particles along the path: {:.1e} of the largest force",
                               worst / largest_force(path)));
}

std::vector<double> turned(const Model& model, const std::vector<double>& displacements) {
  constexpr double c = 0.5403023058681398, s = 0.8414709848078965;  // one radian
  const double along = 1 / std::sqrt(14.0);
  const Vec3 axis{along, 2 * along, 3 * along};
  std::vector<double> result;
  for (Particle p = 0; p < displacements.size() / 3; ++p) {
    const Vec3 rest = model.body.position(p),
               at = rest +
                    Vec3{displacements[3 * p], displacements[3 * p + 1], displacements[3 * p + 2]};
    const Vec3 moved = c * at + s * cross(axis, at) + ((1 - c) * dot(axis, at)) * axis - rest;
    result.insert(result.end(), {moved.x, moved.y, moved.z});
  }
  return result;
}

/// Compares the forces of a cell of eight particles with random displacements, upright and rotated
/// by one radian.
Finding objective(const Model& model, const LoneSpring& spring) {
  const std::size_t count = 3 * model.body.particles;
  const double time_step = spring.period() / 10, amplitude = spring.reach();
  DrivenBody upright(model), leaning(model);
  std::vector<double> forces, expected, seen;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const std::vector<double> u = noise(count, amplitude, seed);
    forces = upright.forces(u, time_step);
    seen = leaning.forces(turned(model, u), time_step);
  }
  // forces rotate like positions: the rest positions cancel in the difference of two rotated states
  const std::vector<double> origin = turned(model, std::vector<double>(count, 0.0));
  expected = turned(model, forces);
  for (std::size_t n = 0; n < count; ++n) expected[n] -= origin[n];
  const double error = distance(expected, seen) / largest(forces);
  return passes_if(
      error < 1e-7,
      fmt::format("a cell turned by a radian: forces turn with it, but for {:.1e} of the largest",
                  error));
}

Finding energy_balance(const Model& model, const LoneSpring& spring) {
  const double speed = spring.reach() / (2 * spring.period());
  const MotionResult coarse = run_motion(model, {speed, 0.4}),
                     fine = run_motion(model, {speed, 0.1});
  return passes_if(coarse.largest_error < 0.02 &&
                       fine.largest_error < std::max(1e-10, coarse.largest_error / 2.5),
                   fmt::format("a block set in motion: relative error of the energy balance {:.1e} "
                               "at 0.4 of the critical step, {:.1e} at 0.1",
                               coarse.largest_error, fine.largest_error));
}

Finding same_bits(const Model& model, const LoneSpring& spring) {
  const double speed = spring.reach() / (2 * spring.period());
  RandomMotion motion{speed};
  const MotionResult one = run_motion(model, motion);
  motion.threads = 3;
  return passes_if(one.is_finite() && run_motion(model, motion).hash == one.hash,
                   "with 1 and 3 threads");
}

Finding restart(const Model& model, const LoneSpring& spring) {
  const double speed = spring.reach() / (2 * spring.period());
  RandomMotion motion{speed};
  const MotionResult whole = run_motion(model, motion);
  motion.cut_off = true;
  const MotionResult cut_off = run_motion(model, motion);
  return passes_if(whole.is_finite() && cut_off.hash == whole.hash &&
                       cut_off.balance.error == whole.balance.error,
                   "the same bits, and the same energies, when it is cut off half-way and goes on");
}

/// Plans a scene with the material. Returns the first fault; empty if there is none.
std::string refusal_of(const Scenes& scenes, const std::vector<Json>& stages,
                       std::unique_ptr<Plan>& plan, const char* precision = "double") {
  try {
    plan = scenes.plan_of(stages, 1, precision);
  } catch (const InputError& error) {
    return "refused: " + error.faults().front().expected;
  }
  return "";
}

Finding in_floats(const Trial& trial, const LoneSpring& spring) {
  std::unique_ptr<Plan> plan;
  if (std::string refused =
          refusal_of(trial.scenes, {trial.scenes.grid_box(2, 1, 1), trial.example}, plan, "float");
      !refused.empty())
    return not_applicable(std::move(refused));
  return kernels_follow_the_law(*plan->model, spring, 1e-5);
}

Finding in_a_list(const Trial& trial, const LoneSpring& spring) {
  std::unique_ptr<Plan> plan;
  if (std::string refused =
          refusal_of(trial.scenes, {trial.scenes.listed_box(5, 4, 6), trial.example}, plan);
      !refused.empty())
    return not_applicable(std::move(refused));
  const Finding kept = energy_balance(*plan->model, spring), same = same_bits(*plan->model, spring);
  return passes_if(kept.verdict == Verdict::passed && same.verdict == Verdict::passed,
                   kept.detail + "; the same bits " + same.detail);
}

Finding path_and_picture(const Trial& trial, const LoneSpring& spring) {
  const std::vector<PathPoint> path = usual_path(spring);
  const double force = largest_force(path);
  std::string detail = fmt::format("to an elongation of {:.3g} m and a force of {:.3g} N",
                                   2.5 * spring.reach(), force);
  if (!trial.pictures.empty()) {
    std::filesystem::create_directories(trial.pictures);
    const std::filesystem::path file = trial.pictures / (trial.component.type() + ".svg");
    write_file(file.string(), picture(trial.component.type(), path));
    detail += ", drawn in " + file.string();
  }
  return passes_if(std::isfinite(force) && force > 0, std::move(detail));
}

/// Measures the fracture energy, J/m2: the work that separates a cell inside a large body, pulled
/// along x without lateral contraction.
Finding fracture_energy(const Scenes& scenes, const Json& material) {
  const auto plan = scenes.plan_of({scenes.grid_box(1, 1, 1, "cells"), material});
  const Model& model = *plan->model;
  const LoneSpring spring(model);
  const double piece = spring.reach() / 100, time_step = spring.period() / 10,
               area = model.body.grid.spacing * model.body.grid.spacing;
  constexpr int most = 10000;
  DrivenBody cell(model);
  double work = 0, last = 0, strongest = 0;
  std::vector<double> u(3 * model.body.particles, 0.0);
  for (int n = 0; n < most; ++n) {
    double pull = 0;
    for (Particle p = 0; p < model.body.particles; ++p)
      if (model.body.position(p).x > 0.5 * model.body.grid.spacing) u[3 * p] = n * piece;
    const std::vector<double> forces = cell.forces(u, time_step);
    for (std::size_t f = 0; f < forces.size(); f += 3)
      if (u[f] > 0) pull -= forces[f];
    work += 0.5 * (last + pull) * piece;
    strongest = std::max(strongest, pull);
    if (pull < 1e-9 * strongest) {
      const Json resolved = Json::parse(plan->scene->resolved).at("pipeline").at(1);
      const std::string took =
          fmt::format("a cell pulled apart along [100] takes {:.4g} J/m2", work / area);
      if (!resolved.contains("fracture_energy") || !resolved["fracture_energy"].is_number())
        return passes_if(work > 0, took + "; none is declared");
      const double declared = resolved["fracture_energy"].get<double>();
      return passes_if(std::abs(work / area / declared - 1) < 0.01,
                       fmt::format("{}, declared are {:.4g}", took, declared));
    }
    last = pull;
  }
  return not_applicable(
      fmt::format("springs hold up to a strain of {:.2g}", most * piece / spring.rest_length()));
}

}  // namespace

void check_material(Trial& trial) {
  const Scenes& scenes = trial.scenes;
  const auto pair = scenes.plan_of({scenes.grid_box(2, 1, 1), trial.example}),
             cell = scenes.plan_of({scenes.grid_box(2, 2, 2), trial.example});
  const auto block = scenes.plan_of({scenes.grid_box(5, 4, 6), trial.example});
  const LoneSpring spring(*pair->model);
  trial.check("one-spring path", [&] { return path_and_picture(trial, spring); });
  trial.check("force is the derivative of the energy", [&] { return force_from_energy(spring); });
  trial.check("dissipation is never negative", [&] { return dissipates(spring); });
  trial.check("tangent", [&] { return tangent(*pair->model, spring); });
  trial.check("kernels follow the law",
              [&] { return kernels_follow_the_law(*pair->model, spring, 1e-9); });
  trial.check("in floats", [&] { return in_floats(trial, spring); });
  trial.check("objectivity", [&] { return objective(*cell->model, spring); });
  trial.check("fracture energy", [&] { return fracture_energy(scenes, trial.example); });
  trial.check("energy balance", [&] { return energy_balance(*block->model, spring); });
  trial.check("same bits", [&] { return same_bits(*block->model, spring); });
  trial.check("in a list", [&] { return in_a_list(trial, spring); });
  trial.check("restart", [&] { return restart(*block->model, spring); });
}

}  // namespace hyperlattice::contract
