// Cuts that close, with friction: against the body without the cut, Coulomb's law, and the closed
// form of an inclined crack under compression.
#include <support/archives.hpp>
#include <support/cuts.hpp>
#include <support/energy_balance.hpp>
#include <support/loaded_block.hpp>
#include <support/models.hpp>
#include <support/scenes.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace friction_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

Stages friction(double degrees, const Keys& more = {}) {
  return stage("loads.friction", Keys{{"angle", degrees * std::numbers::pi / 180}} + more);
}

/// A block of 8 x 7 x 6 cells with these cuts, under these loads.
std::unique_ptr<Plan> block_plan(const Json& cuts, const Stages& loads,
                                 const Keys& material = {{"poisson", 0.25}},
                                 const Keys& lattice = {{"boundary", "cells"}}) {
  return plan_of(loaded_block(8, 7, 6, loads, 1e10, material, Keys{{"cuts", cuts}} + lattice));
}
const Json middle = Json::array({plane({0, 0, 3.5e-3}, {0, 0, 1})});
const Json tilted = Json::array({plane({4.1e-3, 3.2e-3, 3.1e-3}, {-0.2, 0.3, 1})});

std::vector<double> moved(const Plan& plan, int steps, int threads = 1) {
  Simulation simulation(*plan.model, threads);
  for (int n = 0; n < steps; ++n) simulation.step(0.5 * plan.model->step_limit.time_step);
  return displacements(simulation);
}

/// Pressure on both ends, and a push along x that is less than the friction.
Stages pressed(double pressure, double push) {
  Stages loads;
  for (const char* end : {"z_min", "z_max"}) {
    loads =
        loads + stage("loads.pressure", {{"on", end}, {"pressure", pressure}, {"rise", 4e-6}}) +
        stage("loads.force",
              {{"on", end}, {"total", Vec3{end[2] == 'i' ? -push : push, 0, 0}}, {"rise", 8e-6}});
  }
  return loads;
}

TEST(ClosedCut, MovesAsTheWholeBodyWhileItDoesNotSlip) {
  for (const char* boundary : {"particles", "cells"}) {
    const Keys lattice = {{"boundary", boundary}};
    for (const Json& cuts : {middle, tilted}) {
      const Stages loads = pressed(1e6, 8);
      const auto whole = block_plan(Json::array(), loads, {{"poisson", 0.25}}, lattice),
                 closed = block_plan(cuts, loads + friction(89), {{"poisson", 0.25}}, lattice),
                 cut = block_plan(cuts, loads, {{"poisson", 0.25}}, lattice);
      EXPECT_EQ(closed->model->step_limit.time_step, whole->model->step_limit.time_step);
      const auto expected = moved(*whole, 300), found = moved(*closed, 300),
                 without = moved(*cut, 300);
      std::printf("%s: differs by %.1e of the displacements; cut by %.1e\n", boundary,
                  distance(found, expected) / largest(expected),
                  distance(without, expected) / largest(expected));
      EXPECT_LT(distance(found, expected), 1e-10 * largest(expected)) << boundary;
      EXPECT_GT(distance(without, expected), 0.1 * largest(expected)) << boundary;
    }
  }
}

/// Halves are pulled apart: nothing pulls across the cut, and once it is open by more than a tenth
/// of the spacing no force at all is left.
TEST(OpenedCut, CarriesNothing) {
  const Stages loads = pressed(-1e6, 3);
  for (const Json& cuts : {middle, tilted}) {
    const auto closing = block_plan(cuts, loads + friction(30)), cut = block_plan(cuts, loads);
    const Model& model = *closing->model;
    Simulation simulation(model, 1), without(*cut->model, 1);
    const std::vector<Vec3> none(model.body.particles);
    const auto force_of_faces = [&] {
      const auto with =
                     simulation.external_forces([&]() -> const std::vector<Vec3>& { return none; }),
                 free = without.external_forces([&]() -> const std::vector<Vec3>& { return none; });
      double largest = 0;
      for (Particle p = 0; p < none.size(); ++p)
        largest = std::max(largest, norm(with[p] - free[p]));
      return largest;
    };
    const double dt = 0.5 * model.step_limit.time_step, end = 6e-5;
    double first = 0;
    while (simulation.time() < end) {
      simulation.step(dt);
      without.step(dt);
      first = std::max(first, force_of_faces());
    }
    const auto u = displacements(simulation), v = displacements(without);
    const double apart = largest(v);
    std::printf("largest force %.2e of the pull, displacements off by %.1e of %.2e m\n",
                first / (1e6 * 56e-6), distance(u, v) / apart, apart);
    EXPECT_GT(apart, 0.2e-3);
    EXPECT_LT(first, 0.02 * 1e6 * 56e-6);
    EXPECT_LT(distance(u, v), 0.05 * apart);
    EXPECT_EQ(force_of_faces(), 0);
  }
}

/// Two halves under pressure slide on each other, each at the velocity `speed` against the other.
struct Sliding {
  static constexpr double speed = 1, pressure = 5e4, degrees = 30;
  static constexpr double area = 56e-6, rise = 2e-5;
  std::unique_ptr<Plan> plan;
  explicit Sliding(const Json& cuts = middle)
      : plan(block_plan(
            cuts, stage("loads.start_velocity", {{"on", "half"}, {"linear", {speed, 0, 0}}}) +
                      stage("loads.start_velocity", {{"on", {{"difference", {"all", "half"}}}},
                                                     {"linear", {-speed, 0, 0}}}) +
                      squeezed() + friction(degrees))) {}
  static Stages squeezed() {
    Stages loads;
    for (const char* end : {"z_min", "z_max"})
      loads =
          loads + stage("loads.pressure", {{"on", end}, {"pressure", pressure}, {"rise", rise}});
    return loads;
  }
};

TEST(SlidingBlock, IsBrakedByTheFrictionOfItsPressure) {
  const Sliding block;
  const Model& model = *block.plan->model;
  Simulation simulation(model, 2);
  const Vec3 momentum = sums(model, simulation).momentum;
  const double start = simulation.balance().kinetic, end = 1.2e-4;
  // Momentum of the half below along x, N s, and the slip of the faces, m.
  const auto below_moves = [&](double& slip) {
    std::vector<double> u, v;
    simulation.displacements(u);
    simulation.velocities(v);
    double sum = 0, below = 0, top = 0, count = 0;
    for (Particle p = 0; p < model.body.particles; ++p) {
      const double z = model.body.position(p).z;
      if (z < 3.5e-3) sum += model.mass(p) * v[3 * p];
      if (std::abs(z - 3e-3) < 1e-6) below += u[3 * p], ++count;
      if (std::abs(z - 4e-3) < 1e-6) top += u[3 * p];
    }
    slip = (below - top) / count;
    return sum;
  };
  double slip = 0, work = 0;
  const double at_start = below_moves(slip);
  const double force =
      std::tan(Sliding::degrees * std::numbers::pi / 180) * Sliding::pressure * Sliding::area;
  while (simulation.time() < end) {
    const double before = slip;
    simulation.step(0.5 * model.step_limit.time_step);
    below_moves(slip);
    work += ramp(simulation.time(), Sliding::rise) * force * (slip - before);
  }
  const double at_end = below_moves(slip),
               impulse = force * (simulation.time() - Sliding::rise / 2);
  const EnergyBalance balance = simulation.balance();
  const double taken = -simulation.work_of_loads().back();
  std::printf(
      "impulse %.4f of mu N t, work %.4f of its integral over slip, slip %.3f spacings, error "
      "%.1e\n",
      (at_start - at_end) / impulse, taken / work, slip / 1e-3, balance.relative_error());
  EXPECT_NEAR(at_start - at_end, impulse, 0.02 * impulse);
  EXPECT_GT(slip, 0.1e-3);
  EXPECT_NEAR(taken, work, 0.05 * work);  // the pressure needs a while to come to the faces
  EXPECT_LT(balance.kinetic, start);
  EXPECT_LT(std::abs(balance.relative_error()), 1e-3);
  const Sums now = sums(model, simulation);
  EXPECT_LT(norm(now.momentum - momentum), 1e-12 * now.size);
}

/// Runs, and returns the hash; saves the state half-way and goes on in another simulation.
std::uint64_t interrupted(const Plan& plan, int steps, int threads, bool measures) {
  const double dt = 0.5 * plan.model->step_limit.time_step;
  Simulation first(*plan.model, threads);
  for (int n = 0; n < steps / 2; ++n) {
    first.step(dt);
    if (measures) first.balance();
  }
  Simulation second(*plan.model, threads);
  restore(second, saved(first));
  EXPECT_EQ(second.hash(), first.hash());
  for (int n = steps / 2; n < steps; ++n) second.step(dt);
  return second.hash();
}

TEST(Friction, TheSameBitsForAnyThreadsAndAfterARestart) {
  for (const Json& cuts : {middle, tilted}) {
    const Sliding block(cuts);
    std::vector<std::uint64_t> hashes;
    for (const int threads : {1, 2, 5}) {
      Simulation simulation(*block.plan->model, threads);
      for (int n = 0; n < 400; ++n) simulation.step(0.5 * block.plan->model->step_limit.time_step);
      hashes.push_back(simulation.hash());
    }
    EXPECT_EQ(hashes[1], hashes[0]);
    EXPECT_EQ(hashes[2], hashes[0]);
    EXPECT_EQ(interrupted(*block.plan, 400, 1, false), hashes[0]);
    EXPECT_EQ(interrupted(*block.plan, 400, 2, true), hashes[0]) << "measurements change nothing";
  }
}

TEST(Friction, RefusesBodiesWhoseCutsItCannotClose) {
  const auto fault = [](const Stages& lattice, const Keys& material, const Stages& loads) {
    return faults_of(
        lattice + stage("materials.elastic", Keys{{"young", 1e10}, {"density", 2500}} + material) +
        loads);
  };
  const auto grid = [](const Json& cuts) {
    return stage("lattices.cubic", {{"spacing", 1e-3}, {"shape", box_mm(4, 4, 4)}, {"cuts", cuts}});
  };
  const Keys springs = {{"poisson", 0.25}};
  const Json cuts = Json::array({plane({0, 0, 2e-3}, {0, 0, 1})});
  EXPECT_EQ(fault(grid(cuts), springs, friction(30)), "");
  const struct {
    std::string faults;
    const char* names;
    const char* stage = "/pipeline/2";
  } cases[] = {
      {fault(grid(cuts), {{"poisson", 0.35}}, friction(30)), "without volumetric energy"},
      {fault(grid(cuts), {{"poisson", 0.1}, {"membrane", "I-m"}}, friction(30)), "cross springs"},
      {fault(grid(Json::array()), springs, friction(30)), "that a cut of the lattice passes"},
      {fault(grid(cuts), springs, friction(30) + friction(20)), "no other load closes",
       "/pipeline/3"},
      {fault(grid(cuts), springs, friction(90)), "/pipeline/2/angle"},
      {fault(stage("lattices.random",
                   {{"spacing", 1e-3}, {"shape", box_mm(4, 4, 4)}, {"cuts", cuts}}),
             {}, friction(30)),
       "a lattice on a grid"},
  };
  for (const auto& one : cases) {
    EXPECT_NE(one.faults.find(one.names), std::string::npos) << one.names << ": " << one.faults;
    EXPECT_NE(one.faults.find(one.stage), std::string::npos) << one.faults;
  }
}

/// An inclined crack through a slab under compression along y, in plane strain. The closed form is
/// that of a crack in an endless body whose faces slide against the shear that friction leaves.
struct InclinedCrack {
  static constexpr double half_length = 1, young = 25e9, poisson = 0.25, compression = 100e6;
  double psi = 20 * std::numbers::pi / 180, mu = std::tan(std::numbers::pi / 6);
  double normal_traction = -compression * std::pow(std::sin(psi), 2);
  double driving = compression * std::sin(psi) * std::cos(psi) + mu * normal_traction;
  double slip = 4 * (1 - poisson * poisson) / young * half_length * driving;
  Vec3 along{std::sin(psi), std::cos(psi), 0}, normal{std::cos(psi), -std::sin(psi), 0};
  double spacing;
  std::unique_ptr<Plan> plan;

  /// `cells` in half a length, `half_lengths` from the middle to the edge of the slab.
  InclinedCrack(int cells, int half_lengths, int threads) : spacing(half_length / cells) {
    const double edge = half_lengths * half_length;
    const Vec3 shift = 0.13 * spacing * normal;  // no particle lies on the crack
    const auto corner = [&](double at, double z) {
      const Vec3 x = at * along + shift;
      return Json{x.x, x.y, z};
    };
    const Json crack = {
        {"polygon",
         {{"corners",
           {corner(-half_length, -spacing), corner(half_length, -spacing),
            corner(half_length, 2 * spacing), corner(-half_length, 2 * spacing)}}}}};
    // Ten times the run of a pressure wave across the slab.
    const double rise = 10 * 2 * edge / std::sqrt(1.2 * young / 2500);
    SceneBuilder scene;
    scene.lattice("lattices.cubic", spacing, box({-edge, -edge, 0}, {edge, edge, spacing}),
                  {{"boundary", "cells"}, {"cuts", Json::array({crack})}});
    scene.material(
        "materials.elastic",
        {{"young", young}, {"poisson", poisson}, {"density", 2500}, {"membrane", "none"}});
    for (const char* end : {"y_min", "y_max"})
      scene.load("loads.pressure", {{"on", end}, {"pressure", compression}, {"rise", rise}});
    scene.load("loads.fixed", {{"on", "all"}, {"axes", "z"}});
    scene.stages(friction(30));
    plan = plan_of(
        scene.solver("solvers.explicit", {{"end_time", 1.5 * rise}, {"damping", 0.7}}).text(),
        threads);
  }
  double end_time() const { return plan->stages.back().plan.end_time; }
};

struct Slipped {
  double slip = 0, normal_traction = 0;  ///< over those of the closed form
};

Slipped slip_of(int cells, int half_lengths) {
  const InclinedCrack crack(cells, half_lengths, 2);
  const Model& model = *crack.plan->model;
  Simulation simulation(model, 2);
  simulation.set_damping(0.7);
  const double dt = crack.plan->stages.back().plan.time_step;
  while (simulation.time() < crack.end_time()) simulation.step(dt);
  const std::vector<double> u = displacements(simulation);
  const auto at = [&](Particle p) { return Vec3{u[3 * p], u[3 * p + 1], u[3 * p + 2]}; };
  // Mean jump over the springs that cross the middle of the crack, less that of their shear.
  double jump = 0, count = 0;
  const Vec3 foot = 0.13 * crack.spacing * crack.normal;
  model.body.for_cut_springs([&](Particle a, Particle b, std::uint32_t) {
    Vec3 from = model.body.position(a), to = model.body.position(b), d = at(b) - at(a);
    if (dot(to - from, crack.normal) < 0) {
      std::swap(from, to);
      d = -d;
    }
    const Vec3 middle = 0.5 * (from + to) - foot;
    if (std::abs(dot(middle, crack.along)) > 2 * crack.spacing) return;
    const double shear = -crack.mu * crack.normal_traction / (0.4 * crack.young);
    jump += std::abs(dot(d, crack.along)) - shear * dot(to - from, crack.normal);
    ++count;
  });
  // The forces of the load on the side that the normal points away from, with weights that fall to
  // zero before the tips.
  const std::vector<Vec3> none(model.body.particles);
  const std::vector<Vec3> forces =
      simulation.external_forces([&]() -> const std::vector<Vec3>& { return none; });
  constexpr double reach = 0.8 * InclinedCrack::half_length;
  Vec3 sum;
  for (Particle p = 0; p < model.body.particles; ++p) {
    const Vec3 x = model.body.position(p) - foot;
    const double height = dot(x, crack.normal);
    if (height < 0 && height > -2 * crack.spacing)
      sum += std::max(0.0, 1 - std::abs(dot(x, crack.along)) / reach) *
             Vec3{forces[p].x, forces[p].y, 0};
  }
  const double area = reach * crack.spacing;
  const Slipped found{jump / count / crack.slip,
                      dot(sum, crack.normal) / area / crack.normal_traction};
  std::printf("%d cells, slab of %d half-lengths: slip %.4f, normal traction %.4f\n", cells,
              2 * half_lengths, found.slip, found.normal_traction);
  return found;
}

TEST(InclinedCrack, SlipsAsInTheClosedForm) {
  const InclinedCrack crack(4, 3, 1);
  EXPECT_NEAR(crack.normal_traction, -11.70e6, 0.005e6);
  EXPECT_NEAR(crack.slip, 3.808e-3, 0.0005e-3);
  const Slipped found = slip_of(12, 4);
  EXPECT_NEAR(found.slip, 1, 0.06);
  EXPECT_NEAR(found.normal_traction, 1, 0.05);
}

TEST(LongInclinedCrack, StaysNearTheClosedFormWithTheSpacing) {
  const Slipped found = slip_of(16, 4);
  EXPECT_NEAR(found.slip, 1, 0.07);
  EXPECT_NEAR(found.normal_traction, 1, 0.05);
}

}  // namespace friction_test
