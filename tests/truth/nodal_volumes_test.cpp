// The volumetric energy of lists, nodal volumes: an invariant potential, uniform pressure, the
// calibrated K_v of an independent prototype, dynamics with energy balance, breaking, restarts,
// several materials, floats, refusals.
#include <analyze/load_lattice.hpp>
#include <contract/scenes.hpp>
#include <model/homogenise.hpp>
#include <model/nodal_volumes.hpp>
#include <model/spring_lattice.hpp>
#include <state/particle_stress.hpp>
#include <state/present_volumes.hpp>
#include <support/lists.hpp>

#include <hyperlattice/membranes.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace nodal_volumes_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

constexpr double mm_in_m = 1e-3;

std::unique_ptr<Plan> random_block(int nx, int ny, int nz, double poisson, const Keys& lattice = {},
                                   const Stages& stages = {}, const Keys& material = {},
                                   int threads = 1) {
  return plan_of(listed_scene(random_lattice(nx, ny, nz, Keys{{"sample", 8}} + lattice),
                              Keys{{"poisson", poisson}} + material, stages),
                 threads);
}

std::vector<Vec3> vectors(const std::vector<double>& xyz) {
  std::vector<Vec3> found;
  found.reserve(xyz.size() / 3);
  for (std::size_t n = 0; n < xyz.size(); n += 3) found.push_back({xyz[n], xyz[n + 1], xyz[n + 2]});
  return found;
}

/// The nodal volumes of a body at given displacements.
struct Evaluated {
  Evaluated(const Model& model, const std::vector<Vec3>& moved)
      : volumes(*model.nodal_volumes, moved, {}) {
    for (Particle p = 0; p < model.body.particles; ++p) {
      force.push_back(volumes.force(p));
      energy += volumes.energy(p);
    }
  }
  PresentVolumes volumes;
  std::vector<Vec3> force;
  double energy = 0;
};

TEST(NodalVolumes, ForcesAreDerivativesOfTheEnergy) {
  const auto plan = random_block(5, 5, 5, 0.45);
  const Model& model = *plan->model;
  std::vector<Vec3> moved = vectors(noise(3 * model.body.particles, 0.15 * mm_in_m));
  const Evaluated here(model, moved);
  double largest = 0;
  for (const Vec3 f : here.force) largest = std::max(largest, norm(f));
  constexpr double step = 1e-5 * mm_in_m;
  for (const Particle p : {Particle{0}, Particle{17}, Particle{62}, Particle{124}})
    for (std::size_t c = 0; c < 3; ++c) {
      const auto energy_at = [&](double by) {
        std::vector<Vec3> other = moved;
        other[p][c] += by;
        return Evaluated(model, other).energy;
      };
      const double slope = (8 * (energy_at(step) - energy_at(-step)) -
                            (energy_at(2 * step) - energy_at(-2 * step))) /
                           (12 * step);
      EXPECT_NEAR(here.force[p][c], -slope, 1e-8 * largest) << p;
    }
}

TEST(NodalVolumes, ForcesHaveNoSumAndNoMomentAndTurnWithTheBody) {
  const auto plan = random_block(6, 5, 5, 0.49);
  const Model& model = *plan->model;
  const std::vector<Vec3> moved = vectors(noise(3 * model.body.particles, 0.15 * mm_in_m));
  const Evaluated here(model, moved);
  Vec3 sum, moment;
  double forces = 0, moments = 0;
  for (Particle p = 0; p < model.body.particles; ++p) {
    const Vec3 place = model.body.position(p) + moved[p];
    sum += here.force[p];
    moment += cross(place, here.force[p]);
    forces += norm(here.force[p]);
    moments += norm(place) * norm(here.force[p]);
  }
  EXPECT_LT(norm(sum), 1e-13 * forces);
  EXPECT_LT(norm(moment), 1e-13 * moments);

  const double c = std::cos(1.2), s = std::sin(1.2);
  const auto turned = [c, s](Vec3 x) {
    return Vec3{c * x.x - s * x.y, 0.6 * (s * x.x + c * x.y) - 0.8 * x.z,
                0.8 * (s * x.x + c * x.y) + 0.6 * x.z};
  };
  std::vector<Vec3> after;
  for (Particle p = 0; p < model.body.particles; ++p)
    after.push_back(turned(model.body.position(p) + moved[p]) - model.body.position(p));
  const Evaluated there(model, after);
  EXPECT_NEAR(there.energy / here.energy, 1, 1e-12);
  for (Particle p = 0; p < model.body.particles; ++p)
    ASSERT_LT(norm(there.force[p] - turned(here.force[p])), 1e-13 * forces) << p;
}

/// A uniform growth gives all particles one pressure, which pulls only on the surface.
TEST(NodalVolumes, AUniformPressurePullsOnNoParticleInside) {
  const auto plan = random_block(8, 8, 8, 0.45);
  const Model& model = *plan->model;
  std::vector<Vec3> moved;
  for (Particle p = 0; p < model.body.particles; ++p) moved.push_back(0.1 * model.body.position(p));
  const Evaluated here(model, moved);
  const double modulus = model.materials[0].constants.volumetric, J = 1.1 * 1.1 * 1.1,
               y = 1 / std::cbrt(J), pressure = 3 * modulus * y * (1 - y);
  double largest = 0;
  std::size_t inside = 0;
  for (Particle p = 0; p < model.body.particles; ++p)
    largest = std::max(largest, norm(here.force[p]));
  for (Particle p = 0; p < model.body.particles; ++p) {
    const Vec3 x = model.body.position(p) / mm_in_m;
    if (model.nodal_volumes->rest_volume(p) > 0) {
      EXPECT_NEAR(here.volumes.pressure(p) / pressure, 1, 1e-12);
    }
    if (std::min({x.x, x.y, x.z}) < 2 || std::max({x.x, x.y, x.z}) > 6) continue;
    ++inside;
    ASSERT_LT(norm(here.force[p]), 1e-12 * largest) << p;
  }
  EXPECT_GT(inside, 40U);
}

/// The displacements of a wave of 1e-12 strain give the same digits as larger ones.
TEST(NodalVolumes, SmallDisplacementsLoseNoDigits) {
  const auto plan = random_block(5, 5, 5, 0.4);
  const Model& model = *plan->model;
  const auto forces_at = [&](double amplitude) {
    return Evaluated(model, vectors(noise(3 * model.body.particles, amplitude))).force;
  };
  const std::vector<Vec3> small = forces_at(1e-17), smaller = forces_at(1e-19);
  double largest = 0, difference = 0;
  for (std::size_t p = 0; p < small.size(); ++p) {
    largest = std::max(largest, norm(small[p]));
    difference = std::max(difference, norm(small[p] - 100 * smaller[p]));
  }
  EXPECT_LT(difference, 1e-11 * largest);
}

/// K_v of an independent prototype, k = l = 1, whose samples have other points: an error of 0.002
/// in nu, as between samples of this size, is one of about a tenth in K_v.
TEST(NodalVolumes, SamplesNeedTheModulusOfThePrototype) {
  Host host({std::string(HYPERLATTICE_BUILD) + "/lib/hyperlattice"});
  for (const auto& [coordination, poisson, expected] :
       {std::tuple{"8.4", 0.4, .4292}, {"8.4", 0.45, 1.3331}, {"13.2", 0.45, 4.182}}) {
    const LatticeGeometry geometry = load_lattice(
        host, "lattices.random", {"coordination=" + std::string(coordination), "sample=12"});
    const LatticeFacts facts = facts_of(geometry);
    const double modulus = membranes::volumetric(facts, poisson);
    EXPECT_NEAR(modulus * geometry.spacing / expected, 1, 0.12) << coordination << ", " << poisson;
    MaterialConstants constants = membranes::constants(facts, {});
    constants.volumetric = modulus;
    EXPECT_NEAR(facts.elastic_constants(constants).poisson(), poisson, 1e-5);
  }
}

/// The body has the E and nu that the scene asks for.
TEST(NodalVolumes, MaterialsHaveTheirModulus) {
  const auto plan = random_block(6, 6, 6, 0.45);
  const Model& model = *plan->model;
  const ElasticConstants own = homogenise(model.body.listed, 0, model.body.grid.membrane_distance,
                                          model.materials[0].constants);
  EXPECT_NEAR(own.poisson(), 0.45, 1e-5);
  EXPECT_NEAR(own.young() / 1e10, 1, 1e-5);
}

/// A free body after a random push: momentum is conserved, and the error of the energy falls with
/// the square of the step.
TEST(NodalVolumes, AFreeBodyKeepsItsEnergy) {
  double before = 0;
  for (const double fraction : {0.4, 0.2}) {
    const auto plan = random_block(6, 6, 6, 0.45);
    Simulation simulation(*plan->model, 1);
    simulation.set_velocities(noise(3 * plan->model->body.particles, 30), {});
    const double step = fraction * plan->model->step_limit.time_step;
    const Vec3 momentum = simulation.balance().momentum;
    double worst = 0;
    for (int n = 0; n < static_cast<int>(40 / fraction); ++n) {
      simulation.step(step);
      worst = std::max(worst, std::abs(simulation.balance().relative_error()));
    }
    const EnergyBalance balance = simulation.balance();
    EXPECT_GT(balance.stored, 0.2 * balance.scale);
    const double mass = 2500 * 216e-9, speed = std::sqrt(2 * balance.scale / mass);
    EXPECT_LT(norm(balance.momentum - momentum), 1e-12 * mass * speed);
    EXPECT_LT(worst, 1e-3);
    if (before > 0) {
      EXPECT_LT(worst, 0.35 * before);
    }
    before = worst;
  }
}

std::uint64_t hash_after(int threads, const Keys& material, const std::string& precision,
                         std::uint64_t& broken) {
  const std::string scene = SceneBuilder(listed_scene(random_lattice(7, 6, 8, {{"sample", 8}}),
                                                      Keys{{"poisson", 0.45}} + material))
                                .key("precision", precision)
                                .text();
  const auto plan = plan_of(scene, threads);
  Simulation simulation(*plan->model, threads);
  simulation.set_velocities(noise(3 * plan->model->body.particles, 200), {});
  for (int n = 0; n < 40; ++n) simulation.step(0.8 * plan->model->step_limit.time_step);
  broken = simulation.broken();
  return simulation.hash();
}

TEST(NodalVolumes, TheBitsAreTheSameForAnyNumberOfThreads) {
  const Keys breaking = {{"failure", {{"type", "failures.elongation"}, {"limit", 3e-5}}}};
  for (const char* precision : {"double", "float"})
    for (const Keys& material : {Keys{}, breaking}) {
      std::uint64_t broken = 0, other = 0;
      const std::uint64_t one = hash_after(1, material, precision, broken);
      if (material.json().empty()) {
        EXPECT_EQ(broken, 0U);
      } else {
        EXPECT_GT(broken, 20U);
      }
      for (const int threads : {2, 3}) {
        EXPECT_EQ(hash_after(threads, material, precision, other), one) << precision << threads;
        EXPECT_EQ(other, broken);
      }
    }
}

TEST(NodalVolumes, FloatsAreNearDoubles) {
  const auto displacements_in = [](const char* precision) {
    const auto plan = plan_of(
        SceneBuilder(listed_scene(random_lattice(6, 6, 6, {{"sample", 8}}), {{"poisson", 0.45}}))
            .key("precision", precision)
            .text());
    Simulation simulation(*plan->model, 1);
    simulation.set_velocities(noise(3 * plan->model->body.particles, 1), {});
    for (int n = 0; n < 50; ++n) simulation.step(0.8 * plan->model->step_limit.time_step);
    return displacements(simulation);
  };
  const std::vector<double> exact = displacements_in("double");
  EXPECT_LT(distance(displacements_in("float"), exact), 1e-4 * largest(exact));
}

/// Every event of failure releases energy, and the balance closes to the square of the step.
TEST(NodalVolumes, FailureReleasesEnergy) {
  double before = 0;
  for (const double fraction : {0.8, 0.4}) {
    const auto plan = random_block(
        7, 7, 7, 0.45, {}, {}, {{"failure", {{"type", "failures.elongation"}, {"limit", 5e-5}}}});
    Simulation simulation(*plan->model, 1);
    std::vector<double> velocities;
    for (Particle p = 0; p < plan->model->body.particles; ++p) {
      const Vec3 x = plan->model->body.position(p);
      for (const double along : {x.x, x.y, x.z}) velocities.push_back(6e4 * (along - 3.5e-3));
    }
    simulation.set_velocities(velocities, {});
    double lost = 0, worst = 0;
    for (int n = 0; n < static_cast<int>(60 / fraction); ++n) {
      simulation.step(fraction * plan->model->step_limit.time_step);
      const EnergyBalance balance = simulation.balance();
      EXPECT_GE(balance.dissipated_failure, lost) << n;
      lost = balance.dissipated_failure;
      worst = std::max(worst, std::abs(balance.relative_error()));
    }
    EXPECT_GT(simulation.broken(), 100U);
    EXPECT_LT(worst, 2e-2);
    if (before > 0) {
      EXPECT_LT(worst, 0.7 * before);
    }
    before = worst;
  }
}

/// A spring that breaks ends the energies of all particles at the tetrahedra with this edge, also
/// after a restart.
TEST(NodalVolumes, ARestartHasTheSameBits) {
  const auto plan = random_block(6, 6, 6, 0.45, {}, {},
                                 {{"failure", {{"type", "failures.elongation"}, {"limit", 3e-5}}}});
  const double step = 0.8 * plan->model->step_limit.time_step;
  Simulation first(*plan->model, 2);
  first.set_velocities(noise(3 * plan->model->body.particles, 200), {});
  for (int n = 0; n < 20; ++n) first.step(step);
  EXPECT_GT(first.broken(), 10U);
  const std::unique_ptr<Simulation> restarted = contract::restarted(first, *plan->model, 2);
  Simulation& second = *restarted;
  for (int n = 0; n < 20; ++n) {
    first.step(step);
    second.step(step);
  }
  EXPECT_EQ(first.hash(), second.hash());
  EXPECT_EQ(first.balance().stored, second.balance().stored);
}

/// Two materials in one list: the modulus of a particle is that of its own material.
TEST(NodalVolumes, EachParticleHasTheModulusOfItsMaterial) {
  const auto plan =
      plan_of(listed_scene(random_lattice(6, 6, 6, {{"sample", 8}}), {{"poisson", 0.45}},
                           stage("materials.elastic", {{"young", 2e9},
                                                       {"density", 2500},
                                                       {"poisson", 0.4},
                                                       {"region", box({0, 0, 3e-3}, {1, 1, 1})}})));
  const Model& model = *plan->model;
  ASSERT_EQ(model.materials.size(), 2U);
  for (Particle p = 0; p < model.body.particles; ++p)
    if (model.nodal_volumes->rest_volume(p) > 0) {
      EXPECT_EQ(model.nodal_volumes->modulus(p),
                model.materials[model.kinds.material(p)].constants.volumetric);
    }
  Simulation simulation(model, 1);
  simulation.set_velocities(noise(3 * model.body.particles, 3), {});
  for (int n = 0; n < 100; ++n) simulation.step(0.5 * model.step_limit.time_step);
  EXPECT_LT(std::abs(simulation.balance().relative_error()), 1e-3);
}

/// Internal forces, stress and energy density know the volumetric energy.
TEST(NodalVolumes, FieldsKnowTheEnergy) {
  const auto plan = random_block(7, 7, 7, 0.45);
  const Model& model = *plan->model;
  Simulation simulation(model, 1);
  std::vector<double> moved;
  for (Particle p = 0; p < model.body.particles; ++p) {
    const Vec3 x = model.body.position(p);
    for (const double along : {x.x, x.y, x.z}) moved.push_back(1e-6 * along);
  }
  simulation.set_displacements(moved, {});
  const PresentSprings springs(model, simulation);
  double stored = 0;
  const std::vector<double> densities = energy_densities(springs);
  for (Particle p = 0; p < model.body.particles; ++p)
    stored += densities[p] * model.body.share(p) * model.body.grid.site_volume;
  EXPECT_NEAR(simulation.balance().stored / stored, 1, 1e-10);
  Vec3 sum;
  double size = 0;
  for (const Vec3 force : internal_forces(springs)) {
    sum += force;
    size += norm(force);
  }
  EXPECT_LT(norm(sum), 1e-12 * size);
  // The mean pressure inside of a body that grows is K tr e of its springs, as if alike, and K_v.
  const std::vector<Symmetric> stresses = cauchy_stresses(springs);
  const double alone = pressure(stresses[model.body.particles / 2]);
  EXPECT_LT(alone, -3e-6 * model.materials[0].constants.volumetric);
}

/// The forces of a step are those that fields show.
TEST(NodalVolumes, StepsTakeTheForcesThatFieldsShow) {
  const auto plan = random_block(6, 5, 7, 0.45);
  const std::size_t numbers = 3 * plan->model->body.particles;
  contract::DrivenBody body(*plan->model);
  const std::vector<double> forces = body.forces(noise(numbers, 0.05 * mm_in_m), 1e-9);
  Simulation simulation(*plan->model, 1);
  simulation.set_displacements(noise(numbers, 0.05 * mm_in_m), {});
  const std::vector<Vec3> shown = internal_forces(PresentSprings(*plan->model, simulation));
  for (std::size_t n = 0; n < numbers; ++n)
    ASSERT_NEAR(forces[n], shown[n / 3][n % 3], 1e-9 * largest(forces)) << n;
}

TEST(NodalVolumes, WhatCannotBeIsRefused) {
  const auto refusal = [](const std::string& scene) {
    try {
      plan_of(scene);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const Stages lattice = random_lattice(5, 5, 5, {{"sample", 8}});
  EXPECT_NE(refusal(listed_scene(lattice, {{"poisson", 0.1}})).find("/pipeline/1/poisson"),
            std::string::npos);
  EXPECT_NE(refusal(listed_scene(lattice, {{"poisson", 0.1}, {"volumetric", true}}))
                .find("no K_v below zero on a list of springs"),
            std::string::npos);
  // A sheet of particles has no tetrahedra.
  const ListFiles sheet({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 0.3, 0}},
                        {{0, 1}, {0, 2}, {1, 2}, {1, 3}, {2, 3}, {1, 4}, {3, 4}});
  EXPECT_NE(
      refusal(listed_scene(sheet.lattice(), {{"poisson", 0.45}})).find("corners of tetrahedra"),
      std::string::npos);
}

}  // namespace nodal_volumes_test
