// Laws with constants and memory on lists. In a list, each end of a spring keeps its own copy of
// the memory. The tests therefore first check that both ends agree, then closed forms, agreement
// with the grid, and the energy balance.
#include <support/laws.hpp>
#include <support/lists.hpp>

#include <hyperlattice/chance.hpp>

#include <gtest/gtest.h>

namespace listed_laws_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

const LawCase laws[] = {
    {"viscous", R"("type": "materials.viscous", "time": 2e-7, "membrane": "none")"},
    {"viscous_4D", R"("type": "materials.viscous", "time": 2e-7, "membrane": "I", "lambda": 1.7)"},
    {"relaxing", R"("type": "materials.relaxing", "time": 1e-6, "share": 0.6, "membrane": "none")"},
    {"relaxing_clamped",
     R"("type": "materials.relaxing", "time": 1e-6, "share": 0.6, "membrane": "III", "lambda": 2)"},
    {"softening",
     R"("type": "materials.softening", "strength": 3e6, "fracture_energy": 5, "membrane": "none")"},
    {"softening_4D",
     R"("type": "materials.softening", "strength": 3e6, "fracture_energy": 5, "membrane": "I", "lambda": 1.7)"},
    {"scattered_4D",
     R"("type": "materials.scattered", "modulus": 3, "membrane": "I", "lambda": 1.7)"},
};
class ListedLaw : public testing::TestWithParam<LawCase> {};
INSTANTIATE_TEST_SUITE_P(All, ListedLaw, testing::ValuesIn(laws),
                         [](const auto& info) { return info.param.name; });

// Both ends of a spring.

/// Many separate pairs of particles with springs of all lengths and directions. The two particles
/// of a pair are far apart in the list.
struct Pairs {
  static constexpr int number = 300;
  std::vector<Vec3> places;
  std::vector<std::pair<int, int>> springs;

  Pairs() {
    const std::vector<double> random = noise(6 * number, 1, 5);
    const auto chance = [&](int n, int which) {
      return random[static_cast<std::size_t>(6 * n + which)];
    };
    for (int n = 0; n < number; ++n)
      places.push_back({3.0 * n, 9 * chance(n, 0), 9 * chance(n, 1)});
    for (int n = 0; n < number; ++n) {
      const Vec3 reach{chance(n, 2), chance(n, 3), chance(n, 4)};
      places.push_back(places[static_cast<std::size_t>(n)] +
                       (1 / norm(reach) + 0.3 * chance(n, 5)) * reach);
      springs.emplace_back(n, number + n);
    }
  }
};

TEST_P(ListedLaw, BothEndsOfASpringKeepTheSameBits) {
  const Pairs pairs;
  const ListFiles files(pairs.places, pairs.springs);
  for (const bool breaks : {false, true})
    for (const bool floats : {false, true}) {
      const std::string scene =
          law_scene(files.lattice(), GetParam().material + (breaks ? law_failure : Keys{}));
      const auto plan = plan_of(floats ? in_floats(scene) : scene);
      const Model& model = *plan->model;
      LedBody body(model, 3);
      std::vector<double> u(3 * model.body.particles, 0.0);
      std::size_t pulling = 0;
      for (unsigned step = 0; step < 60; ++step) {
        const std::vector<double> move = noise(u.size(), 3e-7, step);
        for (std::size_t n = 0; n < u.size(); ++n) u[n] += move[n];
        const std::vector<double> forces = body.forces(u);
        for (const ListedSpring& spring : model.body.listed.springs)
          for (std::size_t c = 0; c < 3; ++c) {
            ASSERT_EQ(forces[3 * spring.a + c], -forces[3 * spring.b + c]) << step;
            pulling += forces[3 * spring.a + c] != 0 ? 1 : 0;
          }
      }
      EXPECT_EQ(removed_springs(body.simulation()) == 0, !breaks);
      EXPECT_GT(pulling, 3u * Pairs::number * 20);
    }
}

// A spring's random number follows from the places of its points in the file, however the program
// sorts the list.
TEST(ListedLaws, StiffnessScattersByTheNamesOfPoints) {
  const Pairs pairs;
  const ListFiles files(pairs.places, pairs.springs);
  const auto plan = plan_of(law_scene(
      files.lattice(),
      {{"type", "materials.scattered"}, {"modulus", 3}, {"seed", 7}, {"membrane", "none"}}));
  const Model& model = *plan->model;
  const std::vector<double> u = noise(3 * model.body.particles, 1e-6, 1),
                            forces = LedBody(model, 2).forces(u);
  const auto& named = model.body.listed.source;
  for (std::uint32_t n = 0; n < model.body.listed.springs.size(); ++n) {
    const auto [a, b, stiffness] = model.body.listed.springs[n];
    const double share = std::cbrt(-std::log(chance(7, std::min(named[a], named[b]),
                                                    std::max(named[a], named[b])))) /
                         std::tgamma(4.0 / 3);
    const auto at = [&](const std::vector<double>& field, Particle p) {
      return Vec3{field[3 * p], field[3 * p + 1], field[3 * p + 2]};
    };
    const SpringProperties properties = model.spring_properties(a, b, n);
    const double expected = share * properties.stiffness *
                            (norm(properties.rest + at(u, b) - at(u, a)) - properties.rest_length);
    EXPECT_NEAR(norm(at(forces, a)), std::abs(expected), 1e-8 * properties.stiffness * 1e-6);
  }
}

// Closed forms.

TEST(ListedLaws, AViscousPairOscillatesAsTheDampedOscillator) {
  const ListFiles files({{0, 0, 0}, {0, 0.6, 0.8}}, {{0, 1}});
  const auto plan = plan_of(law_scene(
      files.lattice(), {{"type", "materials.viscous"}, {"time", 1e-8}, {"membrane", "none"}}));
  const Model& model = *plan->model;
  const double stiffness = model.spring_properties(0, 1, 0).stiffness, mass = model.mass(0),
               omega = std::sqrt(2 * stiffness / mass), ratio = omega * 1e-8 / 2,
               damped = omega * std::sqrt(1 - ratio * ratio), step = 0.01 / omega;
  ASSERT_LT(ratio, 0.5);
  Simulation simulation(model, 1);
  const bool swapped = model.body.position(0).y > model.body.position(1).y;
  std::vector<double> start{0, -0.6, -0.8, 0, 0.6, 0.8};
  for (double& v : start) v *= swapped ? -1 : 1;
  simulation.set_velocities(start, {});
  double worst = 0;
  const int steps = static_cast<int>(1 / (ratio * 0.01));
  for (int n = 1; n <= steps; ++n) {
    simulation.step(step);
    const std::vector<double> xyz = displacements(simulation);
    const double t = n * step,
                 expected = 2 / damped * std::exp(-ratio * omega * t) * std::sin(damped * t);
    worst = std::max(
        worst, std::abs((swapped ? -1 : 1) * (0.6 * (xyz[4] - xyz[1]) + 0.8 * (xyz[5] - xyz[2])) -
                        expected));
  }
  EXPECT_LT(worst, 0.012 * 2 / omega);
  const EnergyBalance balance = simulation.balance();
  EXPECT_LT(std::abs(balance.relative_error()), 1e-4);
  const double lost = mass * (1 - std::exp(-2));  // 2 * 1/2 m v^2 at the start
  EXPECT_NEAR(balance.dissipated(), lost, 0.02 * lost);
}

// In a held body all springs relax at the same rate. The force on each particle therefore falls as
// the force of one spring does.
TEST(ListedLaws, AStrainedRandomBlockLosesItsForces) {
  for (const char* membrane : {R"("membrane": "none")", R"("membrane": "III", "lambda": 2)"}) {
    const auto plan = plan_of(
        law_scene(random_lattice(6, 5, 4),
                  Keys{{"type", "materials.relaxing"}, {"time", 1e-6}, {"share", 0.6}} + membrane));
    LedBody body(*plan->model, 2);
    const std::vector<double> u = noise(3 * plan->model->body.particles, 1e-7, 1),
                              first = body.forces(u);
    std::vector<double> forces, expected = first;
    for (int n = 1; n <= 200; ++n) forces = body.forces(u);
    for (double& force : expected) force *= 0.4 + 0.6 * std::exp(-200 * LedBody::time_step / 1e-6);
    EXPECT_LT(distance(forces, expected), 1e-10 * largest(first));
  }
}

// Two halves are drawn apart until no spring joins them.
TEST(ListedLaws, ASofteningRandomBlockTakesTheFractureEnergyApart) {
  const Stages halves =
      stage("loads.fixed", {{"on", box({}, {5e-3, 1, 1})}}) +
      stage("loads.displacement",
            {{"on", box({5e-3, 0, 0}, {1, 1, 1})}, {"value", {1e-4, 0, 0}}, {"rise", 1e-4}});
  for (const char* membrane : {R"("membrane": "none")", R"("membrane": "III", "lambda": 2)"}) {
    const auto plan = plan_of(law_scene(
        random_lattice(10, 16, 16),
        Keys{{"type", "materials.softening"}, {"strength", 3e6}, {"fracture_energy", 5}} + membrane,
        halves));
    Simulation simulation(*plan->model, 2);
    for (int n = 0; n < 1000; ++n) simulation.step(1e-7);
    const double expected = 5 * 16e-3 * 16e-3;
    const EnergyBalance balance = simulation.balance();
    std::printf("%s: %.3f of the fracture energy\n", membrane, balance.dissipated() / expected);
    // The cut has about 500 springs of all lengths, and fewer near the surface.
    EXPECT_NEAR(balance.dissipated(), expected, 0.1 * expected);
    EXPECT_LT(std::abs(balance.stored), 0.01 * expected);
    EXPECT_LT(std::abs(balance.relative_error()), 1e-3);
  }
}

// The grid.

/// A block of the cubic lattice as a grid and as a list.
struct LawTwins {
  std::unique_ptr<Plan> grid, list;
  InGrid in_grid;

  LawTwins(int nx, int ny, int nz, const std::string& law, const Keys& more) {
    const ListFiles files(nx, ny, nz);
    const auto scene = [&](const Stages& lattice, double scale, double fracture) {
      const auto material = [&](double stiff, const Keys& where) {
        Keys keys;
        if (law == "viscous") keys = {{"time", stiff * 1e-7}};
        if (law == "relaxing") keys = {{"time", 1e-6}, {"share", 0.4 * stiff}};
        if (law == "softening")
          keys = {{"strength", stiff * scale * 3e6}, {"fracture_energy", stiff * fracture}};
        return stage("materials." + law, Keys{{"density", 2500}, {"young", stiff * scale * 1e10}} +
                                             where + keys + more);
      };
      return SceneBuilder{}
          .stages(lattice)
          .stages(material(1, {}) + material(2, {{"region", box({}, {1, 1, 3e-3})}}))
          .solver("solvers.explicit", {{"end_time", 1}})
          .text();
    };
    const auto opening = [](const Plan& plan) {
      return plan.model->springs.constants[0].law[0][1];
    };
    grid = plan_of(
        scene(stage("lattices.cubic", {{"spacing", 1e-3}, {"shape", box_mm(nx, ny, nz)}}), 1, 5));
    list = plan_of(scene(files.lattice(), 1, 5));
    const double scale =
        grid->model->springs.constants[0].stiffness / list->model->springs.constants[0].stiffness;
    list = plan_of(scene(files.lattice(), scale,
                         law == "softening" ? 5 * scale * opening(*grid) / opening(*list) : 5));
    in_grid = InGrid(nx, ny, nz, *list->model);
  }
};

TEST(ListedLaws, TheCubicLatticeAsAListMovesAsTheGrid) {
  for (const char* law : {"viscous", "relaxing", "softening"})
    for (const char* membrane : {R"("membrane": "none")", R"("membrane": "I", "lambda": 1.7)",
                                 R"("membrane": "III", "lambda": 2)"}) {
      const LawTwins twins(5, 6, 7, law, membrane);
      Simulation grid(*twins.grid->model, 1), list(*twins.list->model, 2);
      const std::vector<double> start = noise(3 * twins.in_grid.size(), 1, 1);
      const std::vector<double> level(
          twins.grid->model->degrees_of_freedom == 4 ? twins.in_grid.size() : 0, 0.0);
      grid.set_velocities(start, level);
      list.set_velocities(twins.in_grid.for_list(start), level);
      for (int n = 0; n < 100; ++n)
        for (Simulation* simulation : {&grid, &list})
          simulation->step(0.4 * twins.grid->model->step_limit.time_step);
      EXPECT_LT(distance(twins.in_grid.for_list(displacements(grid)), displacements(list)),
                1e-10 * largest(displacements(grid)))
          << law << membrane;
      const EnergyBalance left = grid.balance(), right = list.balance();
      EXPECT_GT(left.dissipated(), 0.01 * left.scale) << law << membrane;
      EXPECT_NEAR(left.stored, right.stored, 1e-9 * left.scale);
      EXPECT_NEAR(left.kinetic, right.kinetic, 1e-9 * left.scale);
      EXPECT_NEAR(left.dissipated(), right.dissipated(), 1e-9 * left.scale);
    }
}

// Bodies in motion.

std::string random_scene(const Keys& material) {
  return law_scene(random_lattice(6, 5, 6), material);
}

TEST_P(ListedLaw, KeepsMomentumAndTheBooks) {
  const auto plan = plan_of(random_scene(GetParam().material));
  const Ended start = shaken(*plan, 0.4, 1, 2), coarse = shaken(*plan, 0.4, 200, 2),
              fine = shaken(*plan, 0.1, 800, 1);
  const double scale = std::sqrt(2 * start.balance.scale * plan->model->mass(0) *
                                 static_cast<double>(plan->model->body.particles));
  EXPECT_LT(norm(coarse.balance.momentum - start.balance.momentum), 1e-12 * scale);
  if (std::string(GetParam().name) != "scattered_4D") {  // this law is elastic
    EXPECT_GT(fine.balance.dissipated(), 0.02 * fine.balance.scale);
  }
  EXPECT_LT(std::abs(fine.balance.relative_error()), 2e-4);
  EXPECT_LT(std::abs(coarse.balance.relative_error()), 3e-3);
}

TEST_P(ListedLaw, KeepsTheBooksWhileSpringsBreak) {
  const auto plan = plan_of(random_scene(GetParam().material + law_failure));
  const Ended ended = shaken(*plan, 0.1, 400, 2);
  EXPECT_GT(ended.broken, 10u);
  EXPECT_LT(std::abs(ended.balance.relative_error()), 2e-3);
}

TEST_P(ListedLaw, GivesTheSameBitsForAnyNumberOfThreads) {
  const std::string scene = law_scene(random_lattice(9, 8, 7), GetParam().material + law_failure);
  for (const auto& plan : {plan_of(scene), plan_of(in_floats(scene))}) {
    const Ended one = shaken(*plan, 0.4, 100, 1);
    EXPECT_GT(one.broken, 10u);
    for (const int threads : {2, 3, 6}) {
      const Ended more = shaken(*plan, 0.4, 100, threads);
      EXPECT_EQ(more.hash, one.hash) << threads;
      EXPECT_EQ(more.balance.dissipated(), one.balance.dissipated()) << threads;  // to the last bit
      EXPECT_EQ(more.balance.stored, one.balance.stored) << threads;
      EXPECT_EQ(more.broken, one.broken) << threads;
    }
  }
}

TEST(ListedLaws, PlasticSpringsOfAllDirectionsAreRefused) {
  try {
    plan_of(random_scene({{"type", "materials.plastic"}, {"yield", 3e6}, {"membrane", "none"}}));
    FAIL() << "it was planned";
  } catch (const InputError& error) {
    EXPECT_NE(error.faults().front().expected.find("structured lattice"), std::string::npos)
        << error.faults().front().expected;
  }
}

}  // namespace listed_laws_test
