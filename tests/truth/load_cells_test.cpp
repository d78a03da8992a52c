// Forces that probes follow: through plane sections, and of loads. The truth is Newton's: internal
// forces of the kernels, momentum, and moments of known loads.
#include <contract/scenes.hpp>
#include <state/force_sums.hpp>
#include <support/cells.hpp>
#include <support/rest.hpp>

#include <gtest/gtest.h>

#include <numeric>

namespace load_cells_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

/// Planes through the middle of a block of 6 x 5 x 8 mm: normal to axes, and tilted.
struct Plane {
  Vec3 point, normal;
};
const Plane planes[] = {{{3e-3, 2.5e-3, 4e-3}, {0, 0, 1}},
                        {{3e-3, 2.5e-3, 4.1e-3}, {0, 0, -2}},
                        {{3e-3, 2.5e-3, 4e-3}, {1, 0, 0}},
                        {{3e-3, 2.5e-3, 4e-3}, {1, 1, 0}},
                        {{2.9e-3, 2.4e-3, 4.3e-3}, {0.3, -0.5, 0.9}}};
constexpr Vec3 about{1e-3, -2e-3, 3e-3};

std::vector<Particle> all_of(const Model& model) {
  std::vector<Particle> all(model.body.particles);
  std::iota(all.begin(), all.end(), Particle{0});
  return all;
}

bool is_beyond(const Model& model, const Plane& plane, Particle particle) {
  return dot(model.body.position(particle) - plane.point, plane.normal) >
         1e-9 * model.body.grid.spacing * norm(plane.normal);
}

ForcesId section(Simulation& simulation, const Model& model, const Plane& plane) {
  return simulation.force_sums().follow(cut(model, plane.point, plane.normal, all_of(model)));
}

Vec3 at(const std::vector<double>& xyz, Particle particle) {
  return {xyz[3 * particle], xyz[3 * particle + 1], xyz[3 * particle + 2]};
}

void expect_near(Vec3 found, Vec3 expected, double tolerance, const std::string& what) {
  EXPECT_NEAR(found.x, expected.x, tolerance) << what;
  EXPECT_NEAR(found.y, expected.y, tolerance) << what;
  EXPECT_NEAR(found.z, expected.z, tolerance) << what;
}

/// A block in which every particle has its own displacement.
struct Shaken {
  std::unique_ptr<Plan> plan;
  std::vector<double> u, heights;

  explicit Shaken(const std::string& scene) : plan(plan_of(scene)) {
    const std::size_t particles = plan->model->body.particles;
    u = noise(3 * particles, 2e-5, 1);
    if (plan->model->degrees_of_freedom == 4) heights = noise(particles, 1e-5, 2);
  }
};

/// Compares a section with the internal forces of the kernels on the particles before it.
void expect_internal_forces(const std::string& scene, const std::string& what) {
  const Shaken body(scene);
  const Model& model = *body.plan->model;
  const std::vector<Force> internal = forces(model, body.u, body.heights);
  Simulation simulation(model, 2);
  simulation.set_displacements(body.u, body.heights);
  for (const Plane& plane : planes) {
    Vec3 force, moment;
    double size = 0;
    for (Particle p = 0; p < model.body.particles; ++p) {
      const Vec3 f{internal[p][0], internal[p][1], internal[p][2]};
      size += norm(f);
      if (is_beyond(model, plane, p)) continue;
      force += f;
      moment += cross(model.body.position(p) + at(body.u, p) - about, f);
    }
    ASSERT_GT(size, 0) << what;
    const Resultant found = simulation.force_sums().sum(section(simulation, model, plane), about);
    EXPECT_GT(norm(found.force), 1e-3 * size / static_cast<double>(model.body.particles)) << what;
    expect_near(found.force, force, 1e-13 * size, what);
    expect_near(found.moment, moment, 1e-13 * 1e-2 * size, what);
  }
}

/// Random parts of the cells of the block.
Json parts_of_the_block() { return random_parts({"block", {}, in_box({0, 0, 0}, {6, 5, 8})}); }

TEST(SectionForce, IsTheInternalForceOnThePartBefore) {
  for (const MembraneCase& one : membrane_cases)
    expect_internal_forces(block(6, 5, 8, one), one.name);
  for (const MembraneCase& one : centred_lattices)
    expect_internal_forces(block(6, 5, 8, one), one.name);
  expect_internal_forces(block(6, 5, 8, Keys{}, {}, "lattices.random"), "random");
  expect_internal_forces(scene_of_cells(box_mm(6, 5, 8), {{"poisson", 0.25}}), "cells");
  expect_internal_forces(scene_of_cells(box_mm(6, 5, 8), {{"membrane", "I-m"}, {"poisson", 0.1}}),
                         "cells I-m");
  for (const MembraneCase& one : volumetric) {
    expect_internal_forces(block(6, 5, 8, one), one.name);
    expect_internal_forces(scene_of_cells(box_mm(6, 5, 8), one.material), one.name);
    expect_internal_forces(scene_of_partial_cells(parts_of_the_block(), one.material), one.name);
  }
}

TEST(SectionForce, OfLawsWithMemoryAndOfSeveralLaws) {
  const auto scene = [](const std::string& lattice) {
    return SceneBuilder{}
        .lattice(lattice, 1e-3, box_mm(6, 5, 8))
        .material("materials.elastic", {{"young", 1e10}, {"density", 2500}, {"membrane", "none"}})
        .material("materials.softening", {{"young", 5e9},
                                          {"density", 2500},
                                          {"membrane", "none"},
                                          {"strength", 3e6},
                                          {"fracture_energy", 5},
                                          {"region", box({0, 0, 4e-3}, {1, 1, 1})}})
        .solver("solvers.explicit", {{"end_time", 1e-6}})
        .text();
  };
  for (const char* lattice : {"lattices.cubic", "lattices.random"})
    expect_internal_forces(scene(lattice), lattice);
}

TEST(SectionForce, HasTheAreaOfTheCutCells) {
  const auto area = [](const std::string& scene, const Plane& plane) {
    const auto plan = plan_of(scene);
    return cut(*plan->model, plane.point, plane.normal, all_of(*plan->model)).area;
  };
  const std::string particles = block(6, 5, 8),
                    cells = scene_of_cells(box_mm(6, 5, 8), {{"poisson", 0.25}});
  for (const std::string& scene : {particles, cells}) {
    EXPECT_NEAR(area(scene, {{0, 0, 4.2e-3}, {0, 0, 1}}), 30e-6, 1e-18);
    EXPECT_NEAR(area(scene, {{0.7e-3, 0, 0}, {-3, 0, 0}}), 40e-6, 1e-18);
  }
  // A diagonal cut through the middle: 5 mm times sqrt(2) * 6 mm.
  EXPECT_NEAR(area(cells, {{3e-3, 0, 4e-3}, {1, 0, 1}}) / (30e-6 * std::sqrt(2.0)), 1, 0.02);
  // At the sides of other lattices springs are missing.
  EXPECT_NEAR(area(block(12, 12, 12, Keys{}, {}, "lattices.bcc"), planes[0]) / 144e-6, 1, 0.1);
  EXPECT_NEAR(
      area(block(10, 10, 10, Keys{}, {}, "lattices.random"), {{0, 0, 5e-3}, {0, 0, 1}}) / 100e-6, 1,
      0.1);
}

TEST(SectionForce, TakesOnlySpringsWithinTheRegion) {
  const auto plan = plan_of(block(6, 5, 8));
  const Model& model = *plan->model;
  std::vector<Particle> half;
  for (Particle p = 0; p < model.body.particles; ++p)
    if (model.body.position(p).x < 3e-3) half.push_back(p);
  const PlaneSection section = cut(model, {0, 0, 4e-3}, {0, 0, 1}, half);
  EXPECT_NEAR(section.area, 15e-6, 1e-18);
  for (const CutSpring& spring : section.springs) {
    EXPECT_LT(model.body.position(spring.a).x, 3e-3);
    EXPECT_LT(model.body.position(spring.b).x, 3e-3);
  }
  EXPECT_TRUE(cut(model, {0, 0, 9e-3}, {0, 0, 1}, half).springs.empty());
}

// In equilibrium the section carries minus the loads beyond it, and the support minus all loads.
// The solver stops at a residual, so that each particle keeps some of its force: counted in, the
// balance holds to round-off.
TEST(LoadCells, BalanceAtRest) {
  const std::string loads =
      R"({ "type": "loads.fixed", "on": "z_min", "axes": "xyz" },
         { "type": "loads.force", "on": "z_max", "total": [3, -2, 20] },
         { "type": "loads.gravity", "acceleration": [100, 0, -9.81] },
         { "type": "solvers.static", "tolerance": 1e-12 })";
  const Keys whole = {{"shape", box_mm(6, 5, 8)}},
             partial = {{"shape", box({}, {5.7e-3, 4.6e-3, 8e-3})}, {"boundary", "partial_cells"}};
  for (const auto& [shape, material] : {std::pair<Keys, std::string>{whole, R"("poisson": 0.25)"},
                                        {whole, R"("membrane": "I-m", "poisson": 0.1)"},
                                        {whole, R"("poisson": 0.45)"},
                                        {whole + Keys{{"boundary", "cells"}}, R"("poisson": 0.45)"},
                                        {partial, R"("poisson": 0.45)"}}) {
    const AtRest body(
        scene(Keys{{"spacing", 1e-3}} + shape, elastic(1e10, material) + Stages(loads)));
    ForceSums& sums = body.simulation->force_sums();
    const Model& model = body.model();
    const ForcesId fixed = sums.follow(std::size_t{0}), pull = sums.follow(std::size_t{1}),
                   weight = sums.follow(std::size_t{2});
    sums.measure();
    double mass = 0;
    Vec3 first_moment;
    for (Particle p = 0; p < model.body.particles; ++p) {
      mass += model.mass(p);
      first_moment += model.mass(p) * (model.body.position(p) + at(body.u, p) - about);
    }
    const Vec3 g{100, 0, -9.81};
    expect_near(sums.sum(pull, about).force, {3, -2, 20}, 1e-13, "pull");
    expect_near(sums.sum(weight, about).force, mass * g, 1e-13, "weight");
    expect_near(sums.sum(weight, about).moment, cross(first_moment, g), 1e-15, "weight");
    const OutOfBalance rest(body);
    const Resultant all = rest.on(all_of(model), about);
    EXPECT_LT(norm(all.force), 1e-10);
    expect_near(sums.sum(fixed, about).force, all.force - (Vec3{3, -2, 20} + mass * g), 1e-12,
                material);
    expect_near(sums.sum(fixed, about).moment,
                all.moment - (sums.sum(pull, about).moment + sums.sum(weight, about).moment), 1e-14,
                material);
    for (const Plane& plane : planes) {
      std::vector<Particle> beyond;
      for (Particle p = 0; p < model.body.particles; ++p)
        if (is_beyond(model, plane, p)) beyond.push_back(p);
      const ForcesId external = sums.follow(beyond);
      const ForcesId through = section(*body.simulation, model, plane);
      sums.measure();
      const Resultant cell = sums.sum(through, about), acting = sums.sum(external, about),
                      left = rest.on(beyond, about);
      EXPECT_LT(norm(left.force), 1e-10);
      expect_near(cell.force, acting.force - left.force, 1e-12, material);
      expect_near(cell.moment, acting.moment - left.moment, 1e-14, material);
    }
  }
}

// The loads of a step on the way act in part: the reaction is that of this state of rest.
TEST(LoadCells, BalanceOnTheWayOfAStaticStage) {
  const std::string text = scene({{"spacing", 1e-3}, {"shape", box_mm(3, 3, 6)}},
                                 elastic(1e10, R"("poisson": 0.25)") + Stages(R"(
        { "type": "loads.fixed", "on": "z_min", "axes": "xyz" },
        { "type": "loads.force", "on": "z_max", "total": [0, 0, 20] },
        { "type": "loads.gravity", "acceleration": [0, 0, -1e4] },
        { "type": "solvers.static", "tolerance": 1e-11, "load_steps": 4 })"));
  const auto plan = plan_of(text);
  const Model& model = *plan->model;
  Simulation simulation(model, 1);
  ForceSums& sums = simulation.force_sums();
  const ForcesId fixed = sums.follow(std::size_t{0}), pull = sums.follow(std::size_t{1}),
                 weight = sums.follow(std::size_t{2});
  double mass = 0;
  for (Particle p = 0; p < model.body.particles; ++p) mass += model.mass(p);
  int states = 0;
  StageCalls::Hooks hooks;
  hooks.observe = [&] {
    if (simulation.steps() == 0) return;
    const double share = ++states / 4.0;
    sums.measure();
    EXPECT_NEAR(sums.sum(pull, {}).force.z, 20 * share, 1e-12);
    EXPECT_NEAR(sums.sum(weight, {}).force.z, -1e4 * mass * share, 1e-12);
    EXPECT_NEAR(sums.sum(fixed, {}).force.z, (1e4 * mass - 20) * share, 1e-8);
  };
  StageCalls(model, simulation, plan->stages.front(), 1, std::move(hooks)).run();
  EXPECT_EQ(states, 4);
}

/// Velocities of the particles, and the momentum of those for which chosen(particle) holds.
template <class Chosen>
Vec3 momentum(const Model& model, const Simulation& simulation, const Chosen& chosen) {
  std::vector<double> v;
  simulation.velocities(v);
  Vec3 sum;
  for (Particle p = 0; p < model.body.particles; ++p)
    if (chosen(p)) sum += model.mass(p) * at(v, p);
  return sum;
}

// In motion: change of momentum = forces of loads - what passes on through the section.
TEST(LoadCells, BalanceInMotion) {
  for (const char* material :
       {R"("type": "materials.elastic", "membrane": "none")",
        R"("type": "materials.elastic", "membrane": "I-m", "poisson": 0.1)",
        R"("type": "materials.elastic", "poisson": 0.45)",
        R"("type": "materials.viscous", "membrane": "none", "time": 2e-7)"}) {
    const auto plan =
        plan_of(SceneBuilder{}
                    .lattice("lattices.cubic", 1e-3, box_mm(6, 5, 8))
                    .stages(Keys(material) + Keys{{"young", 1e10}, {"density", 2500}})
                    .load("loads.fixed", {{"on", "z_min"}, {"axes", "xyz"}})
                    .load("loads.force", {{"on", "z_max"}, {"total", Vec3{30, -20, 200}}})
                    .load("loads.gravity", {{"acceleration", Vec3{0, 300, -9.81}}})
                    .solver("solvers.explicit", {{"end_time", 1e-6}})
                    .text());
    const Model& model = *plan->model;
    Simulation simulation(model, 2);
    ForceSums& sums = simulation.force_sums();
    const double dt = 0.5 * model.step_limit.time_step;
    std::vector<ForcesId> loads, sections, beyond;
    for (std::size_t l = 0; l < 3; ++l) loads.push_back(sums.follow(l));
    for (const Plane& plane : planes) {
      sections.push_back(section(simulation, model, plane));
      std::vector<Particle> particles;
      for (Particle p = 0; p < model.body.particles; ++p)
        if (is_beyond(model, plane, p)) particles.push_back(p);
      beyond.push_back(sums.follow(particles));
    }
    for (int n = 0; n < 40; ++n) simulation.step(dt);
    sums.measure();
    Vec3 all;
    for (const ForcesId load : loads) all += sums.sum(load, {}).force;
    std::vector<Vec3> through, acting;
    for (std::size_t n = 0; n < sections.size(); ++n) {
      through.push_back(sums.sum(sections[n], {}).force);
      acting.push_back(sums.sum(beyond[n], {}).force);
    }
    const auto everywhere = [](Particle) { return true; };
    const Vec3 before = momentum(model, simulation, everywhere);
    std::vector<Vec3> before_beyond;
    for (const Plane& plane : planes)
      before_beyond.push_back(
          momentum(model, simulation, [&](Particle p) { return is_beyond(model, plane, p); }));
    simulation.step(dt);
    const double scale = 250;  // N
    expect_near((momentum(model, simulation, everywhere) - before) / dt, all, 1e-11 * scale,
                material);
    for (std::size_t n = 0; n < sections.size(); ++n) {
      const Vec3 after =
          momentum(model, simulation, [&](Particle p) { return is_beyond(model, planes[n], p); });
      expect_near((after - before_beyond[n]) / dt, acting[n] - through[n], 1e-11 * scale, material);
    }
  }
}

// A body that is moved as a whole, ever faster, needs mass times acceleration.
TEST(LoadCells, PrescribedAccelerationNeedsItsForce) {
  const auto plan = plan_of(
      block(3, 3, 3, {{"poisson", 0.25}},
            stage("loads.velocity",
                  {{"on", "all"}, {"value", Vec3{1, 0, 0}}, {"axes", "xyz"}, {"rise", 1e-3}})));
  const Model& model = *plan->model;
  Simulation simulation(model, 1);
  const ForcesId load = simulation.force_sums().follow(std::size_t{0});
  for (int n = 0; n < 20; ++n) simulation.step(0.5 * model.step_limit.time_step);
  simulation.force_sums().measure();
  double mass = 0;
  for (Particle p = 0; p < model.body.particles; ++p) mass += model.mass(p);
  EXPECT_NEAR(simulation.force_sums().sum(load, {}).force.x / (1e3 * mass), 1, 1e-9);
}

// Work of a constant force: force times displacement. The works add up to the injected energy.
TEST(LoadCells, WorkOfLoadsAddsUp) {
  const auto plan = plan_of(block(6, 5, 8, {{"poisson", 0.25}}, R"(
      { "type": "loads.fixed", "on": "z_min", "axes": "xyz" },
      { "type": "loads.force", "on": "z_max", "total": [0, 0, 200] },
      { "type": "loads.gravity", "acceleration": [0, 0, -9.81] })"));
  const Model& model = *plan->model;
  Simulation simulation(model, 2);
  simulation.balance();
  for (int n = 0; n < 40; ++n) simulation.step(0.5 * model.step_limit.time_step);
  const EnergyBalance balance = simulation.balance();
  const std::vector<double> work = simulation.work_of_loads(), u = displacements(simulation);
  ASSERT_EQ(work.size(), 3u);
  EXPECT_NEAR(work[0] + work[1] + work[2], balance.injected, 1e-14 * std::abs(work[1]));
  double moved = 0, pushed = 0, weight = 0;
  for (Particle p = 0; p < model.body.particles; ++p) {
    weight += model.mass(p) * -9.81 * u[3 * p + 2];
    if (model.body.position(p).z < 7e-3) continue;
    moved += u[3 * p + 2];
    ++pushed;
  }
  EXPECT_EQ(work[0], 0);
  EXPECT_NEAR(work[1], 200 * moved / pushed, 1e-12 * work[1]);
  EXPECT_NEAR(work[2], weight, 1e-12 * work[1]);
}

// The same bits for any number of threads, and after a restart, also where springs break.
TEST(LoadCells, AreTheSameForThreadsAndAfterARestart) {
  for (const char* lattice : {"lattices.cubic", "lattices.random"}) {
    const std::string text = block(
        6, 5, 8, R"("failure": { "type": "failures.elongation", "limit": 4e-7 })",
        R"({ "type": "loads.fixed", "on": { "box": { "low": [0, 0, 0], "high": [1, 1, 1.6e-3] } }, "axes": "xyz" },
           { "type": "loads.force", "on": { "box": { "low": [0, 0, 6.4e-3], "high": [1, 1, 1] } }, "total": [300, -200, 2000] })",
        lattice);
    const auto plan = plan_of(text);
    const Model& model = *plan->model;
    const auto readings = [&](int threads, bool cut_off) {
      auto simulation = std::make_unique<Simulation>(model, threads);
      std::vector<double> numbers;
      std::vector<ForcesId> followed;
      const auto follow = [&] {
        followed = {simulation->force_sums().follow(std::size_t{0}),
                    section(*simulation, model, planes[4])};
      };
      follow();
      for (int n = 0; n < 60; ++n) {
        simulation->step(0.5 * model.step_limit.time_step);
        if (cut_off && n == 40) {
          simulation = contract::restarted(*simulation, model, threads);
          follow();
        }
        simulation->force_sums().measure();
        for (const ForcesId one : followed) {
          const auto [force, moment] = simulation->force_sums().sum(one, about);
          numbers.insert(numbers.end(), {force.x, force.y, force.z, moment.x, moment.y, moment.z});
        }
      }
      EXPECT_GT(simulation->broken(), 0u);
      return numbers;
    };
    const std::vector<double> one = readings(1, false);
    EXPECT_EQ(one, readings(2, false)) << lattice;
    EXPECT_EQ(one, readings(3, false)) << lattice;
    EXPECT_EQ(one, readings(2, true)) << lattice;
  }
}

}  // namespace load_cells_test
