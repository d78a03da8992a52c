// The field of damage: the bar whose curve of softening is known in closed form, the profile of
// damage that remains, and what the field must not do. See docs/theory/cohesive.md.
#include <support/archives.hpp>
#include <support/cohesive_bar.hpp>

#include <state/damage_field.hpp>
#include <state/force_sums.hpp>
#include <state/particle_stress.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

namespace damage_test {
using namespace hyperlattice;
using namespace hyperlattice::test;
using namespace hyperlattice::test::cohesive_bar;

struct Softening {
  double peak = 0;       ///< over the strength
  double worst = 0;      ///< distance from the line, over the strength
  double worst_top = 0;  ///< of the damage in the middle from 1 - stress / strength
  double dissipated = 0, stored = 0, error = 0;
  double area = 0;  ///< of the crack over the cross-section
  std::vector<double> damage;
};
/// A confined bar has the curve of a lattice's layers, which leaves the line below a third of the
/// strength (docs/theory/cohesive.md).
Softening pull(Bar& bar, double length, bool confined) {
  Softening found;
  const Model& model = *bar.plan->model;
  const double modulus = model.cohesive[0].modulus,
               toughness = 3.6 * length * strength * strength / modulus;
  const double last = 2 * toughness / strength, step = 0.85 * model.step_limit.time_step;
  const double end = Bar::time(mm(2 * bar.half));
  double compliance = mm(2 * bar.half) / young;  // of the bar; a thin one has not quite E
  bool softens = false;
  for (int n = 0; bar.simulation->time() < end; ++n) {
    bar.simulation->step(step);
    if (n % 50 != 0) continue;
    const double stress = bar.stress() / strength, growth = bar.growth();
    if (!softens && stress > 0.4 && stress < 0.8) compliance = growth / (stress * strength);
    const double w = (growth - stress * strength * compliance) / last;
    found.peak = std::max(found.peak, stress);
    if (w > 0.1) softens = true;
    if (!softens || w > 0.95 || (confined && stress < 0.35)) continue;
    found.worst = std::max(found.worst, std::abs(stress - (1 - w)));
    const double top = largest(damage_of(model, *bar.simulation));
    found.worst_top = std::max(found.worst_top, std::abs(top - (1 - stress)));
  }
  const EnergyBalance balance = bar.simulation->balance();
  found.dissipated = balance.dissipated_failure / (toughness * spacing * spacing);
  found.stored = balance.stored / (toughness * spacing * spacing);
  found.error = balance.relative_error();
  found.area = bar.simulation->crack_surface().area / (spacing * spacing);
  found.damage = damage_of(model, *bar.simulation);
  return found;
}

class BarOfDamage : public testing::TestWithParam<std::pair<int, double>> {};

TEST_P(BarOfDamage, SoftensAlongTheLineOfItsToughness) {
  const auto [ratio, poisson] = GetParam();
  const double length = mm(ratio);
  // A bar whose E is far below C11 snaps: it gives back more energy than its crack takes. If it is
  // confined it has C11.
  const bool confined = poisson > 0.25;
  Bar bar((5 * ratio + 1) / 2, poisson, length, "double", 1, confined);
  const Softening found = pull(bar, length, confined);
  std::printf("b/h %d: peak %.4f line %.4f top %.4f D %.4f stored %.2e balance %.2e area %.4f\n",
              ratio, found.peak, found.worst, found.worst_top, found.dissipated, found.stored,
              found.error, found.area);
  EXPECT_NEAR(found.peak, 1, 0.01);
  EXPECT_LT(found.worst, poisson < 0.25 ? 0.04 : 0.02);
  EXPECT_LT(found.worst_top, ratio == 3 ? 0.06 : 0.04);
  // Beyond w_c the traction falls as w^-3: the springs still hold what they will lose.
  EXPECT_NEAR(found.dissipated + found.stored, 1, 0.03);
  EXPECT_GT(found.dissipated, 0.96);
  EXPECT_NEAR(found.area, 1, 0.03);
  EXPECT_LT(std::abs(found.error), 1e-3);
  // What remains has the profile d = 1 - sin(|x| / b).
  const auto top = std::max_element(
      found.damage.begin(), found.damage.begin() + static_cast<std::ptrdiff_t>(2 * bar.half));
  const int middle = static_cast<int>(top - found.damage.begin());
  EXPECT_LE(std::abs(middle - bar.half), 1);
  for (int i = 0; i <= 2 * bar.half; ++i) {
    const double x = std::abs(i - middle) * spacing / length,
                 expected = x < std::numbers::pi / 2 ? 1 - std::sin(x) : 0;
    EXPECT_NEAR(found.damage[static_cast<std::size_t>(i)], expected, 0.03) << i;
  }
}
INSTANTIATE_TEST_SUITE_P(None, BarOfDamage,
                         testing::Values(std::pair(3, 0.25), std::pair(3, 0.2), std::pair(3, 0.3),
                                         std::pair(3, 0.45)));

struct Torn {
  EnergyBalance balance;
  std::uint64_t hash = 0, broken = 0;
  std::vector<double> damage, u;
};
Torn torn(const Plan& plan, int threads, int steps = 300) {
  Simulation simulation(*plan.model, threads);
  set_tearing(*plan.model, simulation);
  for (int n = 0; n < steps; ++n) {
    simulation.step(0.4 * plan.model->step_limit.time_step);
    if (threads == 2 && n % 37 == 0) simulation.balance();  // measurements change nothing
  }
  Torn found{simulation.balance(), 0, simulation.broken(), damage_of(*plan.model, simulation),
             displacements(simulation)};
  found.hash = simulation.hash();
  return found;
}

TEST(Damage, HasTheSameBitsForAnyNumberOfThreadsAndClosesItsBalance) {
  for (const auto& [boundary, poisson] : {std::pair("cells", 0.25), std::pair("particles", 0.25),
                                          std::pair("cells", 0.45), std::pair("particles", 0.4)}) {
    const auto plan = torn_bar(poisson, "double", boundary);
    const Torn one = torn(*plan, 1), two = torn(*plan, 2), three = torn(*plan, 3);
    std::printf("%s: damaged %.3f broken %llu failure/scale %.3f balance %.2e\n", boundary,
                largest(one.damage), static_cast<unsigned long long>(one.broken),
                one.balance.dissipated_failure / one.balance.scale, one.balance.relative_error());
    EXPECT_EQ(largest(one.damage), 1);
    EXPECT_GT(one.broken, 0u);
    EXPECT_GT(one.balance.dissipated_failure, 0.02 * one.balance.scale);
    EXPECT_LT(std::abs(one.balance.relative_error()), 1e-3);
    for (const Torn* other : {&two, &three}) {
      EXPECT_EQ(one.hash, other->hash);
      EXPECT_EQ(one.balance.dissipated_failure, other->balance.dissipated_failure);
      EXPECT_EQ(one.balance.stored, other->balance.stored);
      EXPECT_EQ(one.broken, other->broken);
    }
  }
}

// Fields and sections see the softened springs and cells as the step does.
TEST(Damage, IsSeenAlikeByFieldsSectionsAndSteps) {
  for (const double poisson : {0.25, 0.2, 0.45}) {
    const auto plan = torn_bar(poisson);
    const Model& model = *plan->model;
    const double dt = 0.4 * model.step_limit.time_step, z = 10.2e-3;
    Simulation simulation(model, 2);
    set_tearing(model, simulation);
    for (int n = 0; n < 200; ++n) simulation.step(dt);
    ASSERT_GT(simulation.broken(), 0u);
    const PresentSprings springs(model, simulation);
    const std::vector<Vec3> forces = internal_forces(springs);
    const std::vector<double> densities = energy_densities(springs);
    std::vector<Particle> all(model.body.particles);
    std::iota(all.begin(), all.end(), Particle{0});
    const ForcesId id = simulation.force_sums().follow(cut(model, {0, 0, z}, {0, 0, 1}, all));
    const Vec3 section = simulation.force_sums().sum(id, {}).force;
    const double stored = simulation.balance().stored;
    std::vector<double> before, after;
    simulation.velocities(before);
    simulation.step(dt);
    simulation.velocities(after);
    double scale = 0, energy = 0;
    for (const Vec3 force : forces) scale = std::max(scale, norm(force));
    Vec3 below;
    for (const Particle p : all) {
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(model.mass(p) * (after[3 * p + c] - before[3 * p + c]) / dt, forces[p][c],
                    1e-11 * scale);
      energy += densities[p] * model.body.share(p) * spacing * spacing * spacing;
      if (model.body.position(p).z < z) below += forces[p];
    }
    EXPECT_NEAR(energy, stored, 1e-12 * stored) << poisson;
    EXPECT_LT(norm(section - below), 1e-12 * scale * static_cast<double>(all.size())) << poisson;
  }
}

class RestartOfDamage : public testing::TestWithParam<double> {};

TEST_P(RestartOfDamage, HasTheSameBits) {
  const auto plan = torn_bar(GetParam());
  const double step = 0.4 * plan->model->step_limit.time_step;
  Simulation whole(*plan->model, 2), first(*plan->model, 2), second(*plan->model, 2);
  set_tearing(*plan->model, whole);
  set_tearing(*plan->model, first);
  for (int n = 0; n < 130; ++n) {
    whole.step(step);
    first.step(step);
  }
  const std::vector<char> bytes = saved(first);
  EXPECT_EQ(restore(second, bytes), bytes.size());
  for (int n = 0; n < 130; ++n) {
    whole.step(step);
    second.step(step);
  }
  EXPECT_EQ(whole.hash(), second.hash());
  EXPECT_EQ(whole.balance().dissipated_failure, second.balance().dissipated_failure);
  EXPECT_EQ(whole.broken(), second.broken());
}

INSTANTIATE_TEST_SUITE_P(Poisson, RestartOfDamage, testing::Values(0.25, 0.45));

class FloatsOfDamage : public testing::TestWithParam<double> {};

TEST_P(FloatsOfDamage, AreTheSame) {
  const auto doubles = torn_bar(GetParam()), floats = torn_bar(GetParam(), "float");
  const Torn exact = torn(*doubles, 1, 150), rounded = torn(*floats, 1, 150);
  std::printf("floats: distance of damage %.2e, D %.2e, balance %.2e\n",
              distance(exact.damage, rounded.damage),
              rounded.balance.dissipated_failure / exact.balance.dissipated_failure - 1,
              rounded.balance.relative_error());
  EXPECT_LT(distance(exact.damage, rounded.damage), 1e-3);
  EXPECT_NEAR(rounded.balance.dissipated_failure / exact.balance.dissipated_failure, 1, 1e-3);
  EXPECT_LT(std::abs(rounded.balance.relative_error()), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Poisson, FloatsOfDamage, testing::Values(0.25, 0.45));

// In a uniform strain the stress is that of the material at every particle: at faces, edges and
// corners too, whatever the boundary, and with a membrane whose heights are uniform.
TEST(Damage, IsDrivenByTheStressOfAUniformStrainUpToTheCorners) {
  const Json corner = {{"difference", {box_mm(6, 5, 6), box({mm(3), mm(2), mm(3)}, {1, 1, 1})}}};
  for (const double poisson : {0.25, 0.1, 0.4})
    for (const char* boundary : {"cells", "particles"}) {
      const auto plan =
          plan_of(SceneBuilder{}
                      .lattice("lattices.cubic", spacing, corner, {{"boundary", boundary}})
                      .material("materials.elastic", cohesive(poisson, 3e-3))
                      .solver("solvers.explicit", {{"end_time", 1}})
                      .text());
      const Model& model = *plan->model;
      BlockSet blocks(model, 1);
      Clock clock;
      DamageField damage(blocks, clock);
      Block& block = blocks[0];
      const Vec3 rows[] = {{3e-7, 2e-7, -1e-7}, {2e-7, -1e-7, 3e-7}, {-1e-7, 3e-7, 2e-7}};
      blocks.for_runs(
          [&](const Block& of, std::uint64_t place, Particle first, std::uint64_t count) {
            for (std::uint64_t n = 0; n < count; ++n) {
              const Vec3 at = model.body.position(first + n);
              for (int c = 0; c < 3; ++c) of.displacement[c].set(place + n, dot(rows[c], at));
              if (model.degrees_of_freedom == 4) of.displacement[3].set(place + n, 1e-10);
              block.noted.push_back(first + n);
            }
          });
      damage.finish();
      damage.evaluate();
      const Site inner{1, 1, 1};  // all of its springs exist
      Symmetric expected{};
      std::vector<std::pair<Particle, Symmetric>> found;
      for (std::uint32_t r = 0; r < block.rows.size(); ++r)
        damage.for_row(block, r, [&](const DamageRecord& record) {
          found.emplace_back(record.particle, record.stress);
          if (record.particle == model.body.at(inner)) expected = record.stress;
        });
      ASSERT_EQ(found.size(), model.body.particles);
      for (const auto& [particle, stress] : found)
        for (std::size_t n = 0; n < 6; ++n)
          EXPECT_NEAR(stress[n], expected[n], 1e-5 * std::abs(expected[0]))
              << boundary << " " << poisson << " particle " << particle;
      if (poisson < 0.25) continue;  // with a membrane the heights decide too
      const double shear = young / (2 * (1 + poisson)), trace = rows[0].x + rows[1].y + rows[2].z,
                   lame = shear * 2 * poisson / (1 - 2 * poisson);
      EXPECT_NEAR(expected[0], lame * trace + 2 * shear * rows[0].x, 1e-5 * expected[0]);
      EXPECT_NEAR(expected[2], lame * trace + 2 * shear * rows[2].z, 1e-5 * expected[0]);
      EXPECT_NEAR(expected[5], 2 * shear * rows[0].y, 1e-5 * expected[0]);
    }
}

// A plate that spins with stresses of 0.3 of the strength: frames do not matter, nothing cracks.
TEST(Damage, StaysZeroInABodyThatSpins) {
  for (const double poisson : {0.25, 0.2, 0.45}) {
    const auto plan =
        plan_of(SceneBuilder{}
                    .lattice("lattices.cubic", spacing, box_mm(8, 8, 1), {{"boundary", "cells"}})
                    .material("materials.elastic", cohesive(poisson, 3e-3))
                    .solver("solvers.explicit", {{"end_time", 1}})
                    .text());
    const Model& model = *plan->model;
    Simulation simulation(model, 1);
    const double rate = std::sqrt(0.3 * strength / 2500) / 4e-3;
    std::vector<double> v(3 * model.body.particles);
    for (Particle p = 0; p < model.body.particles; ++p) {
      const Vec3 at = model.body.position(p);
      v[3 * p] = -rate * (at.y - 4e-3);
      v[3 * p + 1] = rate * (at.x - 4e-3);
    }
    simulation.set_velocities(v, model.degrees_of_freedom == 4
                                     ? std::vector<double>(model.body.particles, 0)
                                     : std::vector<double>{});
    while (simulation.time() < 1.4 * 2 * std::numbers::pi / rate)
      simulation.step(0.8 * model.step_limit.time_step);
    EXPECT_EQ(largest(damage_of(model, simulation)), 0);
    EXPECT_EQ(simulation.balance().dissipated_failure, 0);
    EXPECT_LT(std::abs(simulation.balance().relative_error()), 1e-3);
  }
}

}  // namespace damage_test
