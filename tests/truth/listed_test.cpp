// Listed lattices. The cubic lattice as a list behaves as the grid does, and free bodies keep
// momentum and energy.
#include <engine/stage_calls.hpp>

#include <support/lists.hpp>

#include <gtest/gtest.h>

namespace listed_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

class ListedMembrane : public testing::TestWithParam<MembraneCase> {};
const MembraneCase with_one_ratio[] = {
    {"none", R"("poisson": 0.25)"},
    {"I", R"("membrane": "I", "lambda": 1.7)"},
    {"III", R"("membrane": "III", "lambda": 2)"},
    {"free", R"("membrane": "free", "k_alpha": 0.5, "k_beta": 1.5, "k_gamma": 1.5)"}};
INSTANTIATE_TEST_SUITE_P(Membranes, ListedMembrane, testing::ValuesIn(with_one_ratio),
                         [](const auto& info) { return std::string(info.param.name); });

Keys limit_of_elongation(double limit) {
  return {{"failure", {{"type", "failures.elongation"}, {"limit", limit}}}};
}
Stages fixed(const char* on) { return stage("loads.fixed", {{"on", on}}); }
Stages gravity(Vec3 acceleration) {
  return stage("loads.gravity", {{"acceleration", acceleration}});
}
/// A force on the particles above z = 6 mm.
Stages force_above(Vec3 total) {
  return stage("loads.force", {{"on", box({0, 0, 6e-3}, {1, 1, 1})}, {"total", total}});
}

/// The keys without k_gamma, which lists do not have.
std::string keys_for_list(const std::string& material) {
  const auto gamma = material.find(R"(, "k_gamma")"), poisson = material.find(R"("poisson": 0.25)");
  if (poisson != std::string::npos) return R"("membrane": "none")";
  return material.substr(0, gamma);
}

/// The cubic block as a grid and as a list, with equal stiffness.
struct Twins {
  std::unique_ptr<Plan> grid, list;
  InGrid in_grid;

  Twins(int nx, int ny, int nz, const std::string& material, const Keys& failure = {},
        const Stages& stages = {}) {
    const ListFiles files(nx, ny, nz);
    grid = plan_of(block(nx, ny, nz, material + failure, stages));
    const auto scene = [&](double young) {
      return listed_scene(files.lattice(), keys_for_list(material) + failure, stages, young);
    };
    const double k = grid->model->materials[0].constants.base_stiffness;
    list = plan_of(
        scene(1e10 * k / plan_of(scene(1e10))->model->materials[0].constants.base_stiffness));
    in_grid = InGrid(nx, ny, nz, *list->model);
  }
};

void expect_same_motion(const Twins& twins, Simulation& grid, Simulation& list, double scale) {
  EXPECT_LT(distance(twins.in_grid.for_list(displacements(grid)), displacements(list)),
            1e-11 * scale);
  const EnergyBalance left = grid.balance(), right = list.balance();
  EXPECT_NEAR(left.stored, right.stored, 1e-10 * left.stored);
  EXPECT_NEAR(left.kinetic, right.kinetic, 1e-10 * left.kinetic);
  EXPECT_NEAR(left.injected, right.injected, 1e-10 * std::abs(left.injected) + 1e-14 * left.stored);
}

TEST(ListedLoads, AnswerToAListAsToTheGrid) {
  const Twins twins(
      5, 6, 7, membrane_cases[0].material, "",
      R"({ "type": "loads.actuation", "on": "all", "force": 5, "form": "harmonic", "frequency": 1e6 },
    { "type": "loads.floor", "on": "all", "stiffness": 1e6, "friction": 0.4 }, { "type": "loads.start_velocity", "linear": [1, 0, -2] })");
  Simulation grid(*twins.grid->model, 1), list(*twins.list->model, 3);
  for (int n = 0; n < 100; ++n)
    for (Simulation* simulation : {&grid, &list})
      simulation->step(0.5 * twins.grid->model->step_limit.time_step);
  expect_same_motion(twins, grid, list, 1e-6);
}

TEST_P(ListedMembrane, TheCubicLatticeAsAListMovesAsTheGrid) {
  const Twins twins(5, 6, 7, GetParam().material, {},
                    gravity({0, 0, -9.81}) + fixed("z_min") + force_above({10, 0, 20}));
  const Model& model = *twins.grid->model;
  ASSERT_TRUE(twins.list->model->body.is_listed());
  ASSERT_EQ(twins.list->model->body.particles, model.body.particles);
  ASSERT_EQ(twins.list->model->body.base_springs(), model.body.base_springs());
  Simulation grid(model, 1), list(*twins.list->model, 2);
  const std::size_t particles = model.body.particles;
  const bool heights = model.degrees_of_freedom == 4;
  for (Simulation* simulation : {&grid, &list}) {
    // Local damping jumps where a velocity changes its sign, so that the runs agree only for a
    // short time.
    simulation->set_damping(0.1);
    const auto as_it_counts = [&](const std::vector<double>& field) {
      return simulation == &list ? twins.in_grid.for_list(field) : field;
    };
    simulation->set_displacements(
        as_it_counts(noise(3 * particles, 1e-6, 1)),
        as_it_counts(heights ? noise(particles, 1e-6, 2) : std::vector<double>{}));
    for (int n = 0; n < 200; ++n) {
      simulation->step(0.5 * model.step_limit.time_step);
      if (n == 5) simulation->set_damping(0);
    }
  }
  expect_same_motion(twins, grid, list, 1e-6);
}

TEST_P(ListedMembrane, TheSameSpringsBreakInAListAndInAGrid) {
  const Twins twins(6, 5, 4, GetParam().material, limit_of_elongation(1.5e-6));
  const Model& model = *twins.grid->model;
  Simulation grid(model, 2), list(*twins.list->model, 3);
  for (Simulation* simulation : {&grid, &list}) {
    const std::vector<double> start = noise(3 * model.body.particles, 1e-6, 1);
    simulation->set_displacements(simulation == &list ? twins.in_grid.for_list(start) : start, {});
    for (int n = 0; n < 100; ++n) simulation->step(0.5 * model.step_limit.time_step);
  }
  expect_same_motion(twins, grid, list, 1e-6);
  const auto broken = [&](const Simulation& simulation) {
    std::vector<std::tuple<std::uint64_t, Particle, Particle>> all;
    for (const Breakage& breakage : simulation.breakages()) {
      const bool listed = &simulation == &list;
      const auto [a, b] = std::minmax(listed ? twins.in_grid[breakage.a] : breakage.a,
                                      listed ? twins.in_grid[breakage.b] : breakage.b);
      all.emplace_back(breakage.step, a, b);
    }
    std::sort(all.begin(), all.end());
    return all;
  };
  EXPECT_GT(broken(grid).size(), 30u);
  EXPECT_EQ(broken(grid), broken(list));
  EXPECT_EQ(grid.broken_open(), list.broken_open());
  EXPECT_NEAR(grid.balance().dissipated_failure, list.balance().dissipated_failure,
              1e-10 * grid.balance().dissipated_failure);
}

const MembraneCase random_cases[] = {{"none", R"("membrane": "none")"},
                                     {"I", R"("membrane": "I", "poisson": 0.2)"},
                                     {"clamped", R"("membrane": "III", "lambda": 1)"}};
class RandomBlock : public testing::TestWithParam<MembraneCase> {};
INSTANTIATE_TEST_SUITE_P(Membranes, RandomBlock, testing::ValuesIn(random_cases),
                         [](const auto& info) { return std::string(info.param.name); });

TEST_P(RandomBlock, KeepsMomentumAndTheSchemesEnergy) {
  const auto plan = plan_of(listed_scene(random_lattice(6, 5, 4), GetParam().material));
  const Model& model = *plan->model;
  Simulation simulation(model, 2);
  simulation.set_displacements(noise(3 * model.body.particles, 1e-11, 1), {});
  simulation.set_velocities(noise(3 * model.body.particles, 1e-11 / model.step_limit.time_step, 3),
                            {});
  const double step = 0.5 * model.step_limit.time_step;
  simulation.step(step);
  const EnergyBalance start = simulation.balance();
  const double scale = std::sqrt(2 * start.kinetic_mean * model.materials[0].mass *
                                 static_cast<double>(model.body.particles));
  for (int n = 0; n < 2000; ++n) simulation.step(step);
  const EnergyBalance end = simulation.balance();
  EXPECT_LT(norm(end.momentum - start.momentum), 1e-12 * scale);
  EXPECT_NEAR((end.kinetic + end.stored) / (start.kinetic + start.stored), 1, 1e-6);
}

TEST_P(RandomBlock, HasTheSameBitsForAnyNumberOfThreads) {
  const std::string scene =
      listed_scene(random_lattice(9, 8, 7), GetParam().material + limit_of_elongation(1.5e-6),
                   gravity({0, 0, -9.81}) + fixed("z_min"));
  for (const auto& plan : {plan_of(scene), plan_of(in_floats(scene))}) {
    std::vector<std::uint64_t> hashes;
    std::vector<double> energies;
    std::vector<std::size_t> broken;
    for (const int threads : {1, 2, 3, 7}) {
      Simulation simulation(*plan->model, threads);
      simulation.set_displacements(noise(3 * plan->model->body.particles, 1e-6, 1), {});
      for (int n = 0; n < 200; ++n) simulation.step(0.5 * plan->model->step_limit.time_step);
      hashes.push_back(simulation.hash());
      const EnergyBalance balance = simulation.balance();
      energies.push_back(balance.kinetic + balance.stored + balance.dissipated() +
                         balance.injected);
      broken.push_back(simulation.breakages().size());
    }
    EXPECT_GT(broken[0], 20u);
    for (std::size_t n = 1; n < hashes.size(); ++n) {
      EXPECT_EQ(hashes[n], hashes[0]);
      EXPECT_EQ(energies[n], energies[0]);  // to the last bit
      EXPECT_EQ(broken[n], broken[0]);
    }
  }
}

TEST_P(RandomBlock, FloatsGiveTheForcesAndTheEnergyOfDoubles) {
  // The body is far from the origin, which must not matter.
  const Keys far_box = {{"shape", box({10, 0, 0}, {10.006, 5e-3, 4e-3})}};
  const std::string scene = listed_scene(random_lattice(6, 5, 4, far_box), GetParam().material);
  const auto after_a_step = [](const Plan& plan, double size) {
    Simulation simulation(*plan.model, 1);
    std::vector<double> start = noise(3 * plan.model->body.particles, size, 1), found;
    for (double& u : start) u = static_cast<float>(u);
    simulation.set_displacements(start, {});
    const double stored = simulation.balance().stored;
    simulation.step(0.3 * plan.model->step_limit.time_step);
    simulation.velocities(found);
    return std::pair(found, stored);
  };
  const auto doubles = plan_of(scene), floats = plan_of(in_floats(scene));
  // Sizes in m at a spacing of 1e-3 m: they cover the series, the long series and the root.
  for (const double size : {1e-12, 1e-8, 1e-6, 1e-5, 1e-4, 3e-4}) {
    const auto [exact, energy] = after_a_step(*doubles, size);
    const auto [rounded, its_energy] = after_a_step(*floats, size);
    EXPECT_LT(distance(rounded, exact), 3e-6 * largest(exact)) << size;
    EXPECT_NEAR(its_energy / energy, 1, 1e-6) << size;  // rest positions are rounded too
  }
}

TEST_P(RandomBlock, TheSeriesGivesTheForcesOfTheRoot) {
  const auto plan = plan_of(
      listed_scene(random_lattice(6, 5, 4), GetParam().material + limit_of_elongation(3e-4)));
  const auto velocities = [&](double size) {
    Simulation simulation(*plan->model, 1);
    simulation.set_displacements(noise(3 * plan->model->body.particles, size, 1), {});
    simulation.step(0.3 * plan->model->step_limit.time_step);
    std::vector<double> found;
    simulation.velocities(found);
    return std::pair(found, simulation.breakages().size());
  };
  for (const double size : {1e-12, 1e-8, 1e-6, 1e-5, 1e-4, 3e-4}) {  // m, spacing 1e-3 m
    const auto [fast, broken] = velocities(size);
    setenv("HYPERLATTICE_SPRINGS", "exact", 1);
    const auto [exact, broken_too] = velocities(size);
    unsetenv("HYPERLATTICE_SPRINGS");
    EXPECT_LT(distance(fast, exact), 4e-15 * largest(exact)) << size;
    EXPECT_EQ(broken, broken_too);
  }
}

TEST_P(RandomBlock, IsStableUpToItsCriticalStep) {
  const auto plan = plan_of(listed_scene(random_lattice(6, 6, 6), GetParam().material));
  Simulation simulation(*plan->model, 1);
  simulation.set_displacements(noise(3 * plan->model->body.particles, 1e-10, 1), {});
  for (int n = 0; n < 3000; ++n) simulation.step(0.99 * plan->model->step_limit.time_step);
  EXPECT_LT(largest(displacements(simulation)), 1e-8);
  for (int n = 0; n < 3000; ++n)
    // The bound is safe, and still close.
    simulation.step(1.6 * plan->model->step_limit.time_step);
  EXPECT_GT(largest(displacements(simulation)), 1e-3);
}

TEST_P(RandomBlock, EnergyBalancesWhenSpringsBreak) {
  const auto plan = plan_of(listed_scene(
      random_lattice(8, 6, 6), GetParam().material + limit_of_elongation(1e-6),
      stage("loads.velocity", {{"on", "x_max"}, {"value", {1, 0, 0}}}) + fixed("x_min")));
  Simulation simulation(*plan->model, 2);
  const double step = 0.1 * plan->model->step_limit.time_step;
  while (simulation.time() < 2e-5) simulation.step(step);
  const EnergyBalance balance = simulation.balance();
  EXPECT_GT(simulation.breakages().size(), 100u);
  EXPECT_LT(std::abs(balance.relative_error()), 2e-4);
}

/// The displacements of a plan's body after its first solver has brought it to rest.
std::vector<double> at_rest(const Plan& plan, int threads = 1, RestReport* report = nullptr) {
  Simulation simulation(*plan.model, threads);
  const RestReport found = bring_to_rest(plan, simulation);
  if (report != nullptr) *report = found;
  return displacements(simulation);
}

TEST_P(ListedMembrane, TheCubicLatticeAsAListRestsAsTheGrid) {
  for (const char* preconditioner : {"whole", "incomplete", "multigrid"}) {
    const Twins twins(
        5, 6, 7, GetParam().material, {},
        fixed("z_min") + force_above({100, 0, 300}) +
            stage("solvers.static", {{"tolerance", 1e-9}, {"preconditioner", preconditioner}}));
    const std::vector<double> grid = at_rest(*twins.grid), list = at_rest(*twins.list);
    EXPECT_LT(distance(twins.in_grid.for_list(grid), list), 1e-7 * largest(grid))
        << preconditioner;  // tangents are in single precision
  }
}

/// Moves the particles of z_max along z.
Stages moved_end(double by) {
  return stage("loads.displacement",
               {{"on", "z_max"}, {"axes", "z"}, {"value", Vec3{0, 0, by}}, {"rise", 1e-9}});
}

// Layers of equal springs share a pull evenly, so that the displacement is linear. This is the
// patch test of a list.
TEST(ListedStatics, UniaxialStrainIsUniform) {
  const ListFiles files(4, 4, 9);
  const auto plan = plan_of(
      listed_scene(files.lattice(), {{"membrane", "none"}},
                   stage("loads.fixed", {{"on", "all"}, {"axes", "xy"}}) +
                       stage("loads.fixed", {{"on", "z_min"}, {"axes", "z"}, {"name", "end"}}) +
                       moved_end(1e-5) + stage("solvers.static", {{"tolerance", 1e-10}})));
  const std::vector<double> u = at_rest(*plan);
  for (Particle p = 0; p < plan->model->body.particles; ++p)
    EXPECT_NEAR(u[3 * p + 2], 1e-5 * (plan->model->body.position(p).z - 0.5e-3) / 8e-3, 1e-13);
}

std::string pulled_random_block(int n, const Stages& solver) {
  return listed_scene(random_lattice(n, n, n), {{"membrane", "I"}, {"poisson", 0.2}},
                      fixed("z_min") + moved_end(1e-6) + solver);
}

// The body also has particles on one or two springs, which no force drives.
TEST(ListedStatics, RelaxationAgrees) {
  RestReport quick, slow;
  const auto found = at_rest(
      *plan_of(pulled_random_block(7, stage("solvers.static", {{"tolerance", 1e-9}}))), 1, &quick);
  const auto relaxed = at_rest(
      *plan_of(pulled_random_block(
          7, stage("solvers.relaxation", {{"method", "accelerated"}, {"tolerance", 1e-7}}))),
      1, &slow);
  EXPECT_LT(distance(found, relaxed), 1e-3 * largest(found));
  std::printf("%llu iterations, %llu steps, largest difference %.1e\n",
              static_cast<unsigned long long>(quick.iterations),
              static_cast<unsigned long long>(slow.iterations),
              distance(found, relaxed) / largest(found));
}

TEST(ListedStatics, ResultsDoNotDependOnThreads) {
  const std::string scene = pulled_random_block(17, stage("solvers.static", {{"tolerance", 1e-4}}));
  EXPECT_EQ(at_rest(*plan_of(scene, 1), 1), at_rest(*plan_of(scene, 3), 3));
}

TEST(ListedStatics, ABodyThatNothingHoldsIsToldHowItMoves) {
  const ListFiles files(4, 4, 4);
  const auto plan = plan_of(listed_scene(files.lattice(), {{"membrane", "none"}},
                                         gravity({0, -9.81, 0}) + stage("solvers.static")));
  try {
    at_rest(*plan);
    FAIL() << "it came to rest";
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what())
                  .find("the whole body can move as a rigid one: it slides along (0, -1, 0)"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace listed_test
