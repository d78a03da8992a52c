// The contract of lattices: Young's modulus and the Poisson ratio are as calibrated, and a uniform
// strain causes no force on inner particles.
#include <contract/families.hpp>
#include <model/spring_lattice.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace hyperlattice::contract {
namespace {

/// Returns the example with a box of eight spacings as its shape, if it has the option.
Json in_a_box(const Trial& trial) {
  Json lattice = trial.example;
  const double l = 1e-3, side = 8 * l;
  if (lattice.contains("spacing")) lattice["spacing"] = l;
  if (lattice.contains("shape"))
    lattice["shape"] = {{"box", {{"low", {0, 0, 0}}, {"high", {side, side, side}}}}};
  return lattice;
}

Finding calibration(const Scenes& scenes, const Json& lattice, const char* membrane) {
  std::unique_ptr<Plan> plan;
  try {
    plan = scenes.plan_of({lattice, scenes.material(membrane)});
  } catch (const InputError& error) {
    return not_applicable(error.faults().front().expected);
  }
  const Model& model = *plan->model;
  const LatticeGeometry geometry = geometry_from(model.body);
  const MaterialConstants& constants = model.materials.front().constants;
  const ElasticConstants found = facts_of(geometry).elastic_constants(constants);
  const bool asks_poisson = std::string_view(membrane) != "none";
  const double young = found.young() / 1e10, poisson = found.poisson(),
               anisotropy = 2 * found.C44 / (found.C11 - found.C12);
  return passes_if(
      std::abs(young - 1) < 1e-3 && (!asks_poisson || std::abs(poisson - 0.1) < 1e-3),
      fmt::format(
          "homogenised E is {:.6f} of what was asked, nu {:.6f}{}, 2 C44 / (C11 - C12) {:.4f}",
          young, poisson, asks_poisson ? " (asked 0.1)" : "", anisotropy));
}

/// Checks that a uniform strain causes no force on particles with all their springs: opposite
/// springs have equal forces.
Finding patch(const Model& model) {
  if (model.body.is_listed())
    return not_applicable(
        "particles of a list find their own rest; what they come to is in the calibration");
  const Body& body = model.body;
  std::vector<double> u;
  for (Particle p = 0; p < body.particles; ++p) {
    const Vec3 x = body.position(p);
    u.insert(u.end(), {1e-3 * x.x + 4e-4 * x.y, -3e-4 * x.y + 2e-4 * x.z, 6e-4 * x.z - 5e-4 * x.x});
  }
  std::vector<std::size_t> springs(body.particles, 0);
  double strongest = 0;
  body.for_springs([&](Particle a, Particle b, std::uint32_t spring_class) {
    ++springs[a];
    ++springs[b];
    const Vec3 r = body.position(b) - body.position(a),
               d{u[3 * b] - u[3 * a], u[3 * b + 1] - u[3 * a + 1], u[3 * b + 2] - u[3 * a + 2]};
    take_largest(strongest,
                 model.springs.spring(0, 0, spring_class).stiffness * dot(r, d) / norm(r));
  });
  const std::vector<double> forces = DrivenBody(model).forces(u, 0.1 * model.step_limit.time_step);
  double worst = 0;
  std::size_t inner = 0;
  for (Particle p = 0; p < body.particles; ++p) {
    if (springs[p] != 2 * body.neighbours.size()) continue;
    ++inner;
    for (std::size_t c = 0; c < 3; ++c) take_largest(worst, forces[3 * p + c]);
  }
  if (inner == 0) return not_applicable("the example has no particle with all its springs");
  return passes_if(
      std::isfinite(strongest) && worst < 1e-9 * strongest,
      fmt::format("strained evenly, {} inner particles feel {:.1e} of the force of a spring", inner,
                  worst / strongest));
}

Finding energy_balance(const Model& model) {
  const MotionResult coarse = run_motion(model, {1, 0.4}), fine = run_motion(model, {1, 0.1});
  return passes_if(
      coarse.largest_error < 0.01 && fine.largest_error < std::max(1e-10, coarse.largest_error / 8),
      fmt::format("a body set in motion: relative error of the energy balance {:.1e} at 0.4 of the "
                  "critical step, {:.1e} at 0.1",
                  coarse.largest_error, fine.largest_error));
}

}  // namespace

void check_lattice(Trial& trial) {
  const Json lattice = in_a_box(trial);
  const auto plan = trial.scenes.plan_of({lattice, trial.scenes.material()});
  const Model& model = *plan->model;
  trial.check("calibration without a membrane",
              [&] { return calibration(trial.scenes, lattice, "none"); });
  trial.check("calibration with a membrane",
              [&] { return calibration(trial.scenes, lattice, usual_membrane); });
  trial.check("patch test", [&] { return patch(model); });
  trial.check("energy balance", [&] { return energy_balance(model); });
  trial.check("same bits", [&] {
    const MotionResult one = run_motion(model, {1, 0.4, 40, 1}),
                       three = run_motion(model, {1, 0.4, 40, 3});
    return passes_if(one.is_finite() && one.hash == three.hash, "with 1 and 3 threads");
  });
}

}  // namespace hyperlattice::contract
