// Motion against independent truth: natural frequencies of a cantilever (quadratic finite elements,
// two meshes that differ by less than 0.5 %) and of a free cube (exact), the speed of a wave in a
// bar, and a spinning free block (its strain by finite elements).
#include <support/scenes.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

namespace dynamics_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

struct Solid {
  Vec3 size;  ///< size, m; one corner is at the origin
  double spacing, young, poisson, density;
  const char* boundary = "cells";
  const char* stiffness = "bulk";
};

std::string scene(const Solid& of, const Stages& loads = {}) {
  return SceneBuilder{}
      .lattice("lattices.cubic", of.spacing, box({}, of.size), {{"boundary", of.boundary}})
      .material("materials.elastic", {{"membrane", "I-m"},
                                      {"stiffness", of.stiffness},
                                      {"young", of.young},
                                      {"poisson", of.poisson},
                                      {"density", of.density}})
      .stages(loads)
      .solver("solvers.explicit", {{"end_time", 1}})
      .text();
}

/// Frequency, Hz, of the oscillation after an initial velocity in the shape of a mode. The zeros of
/// the motion's projection on this shape give the period.
template <class Shape>
double frequency(const Model& model, double about, const Shape& shape) {
  Simulation simulation(model, 2);
  std::vector<double> mode, u;
  for (Particle p = 0; p < model.body.particles; ++p) {
    const Vec3 s = shape(model.body.position(p));
    mode.insert(mode.end(), {s.x, s.y, s.z});
  }
  std::vector<double> speeds = mode;
  for (double& speed : speeds) speed *= 1e-3;
  simulation.set_velocities(speeds, {});
  const double step = 0.8 * model.step_limit.time_step;
  // The number of steps between two samples; about a hundred samples make a period.
  const int apart = std::max(1, static_cast<int>(1 / (about * step * 100)));
  double before = 0, first = -1, last = -1;
  int zeros = 0;
  while (simulation.time() < 3.3 / about) {
    for (int n = 0; n < apart; ++n) simulation.step(step);
    simulation.displacements(u);
    double part = 0;
    for (Particle p = 0; p < model.body.particles; ++p)
      part += model.mass(p) * (mode[3 * p] * u[3 * p] + mode[3 * p + 1] * u[3 * p + 1] +
                               mode[3 * p + 2] * u[3 * p + 2]);
    if (before != 0 && (part > 0) != (before > 0)) {
      last = simulation.time() - apart * step * part / (part - before);
      if (zeros++ == 0) first = last;
    }
    before = part;
  }
  return 0.5 * (zeros - 1) / (last - first);
}

TEST(Frequencies, OfACantilever) {
  constexpr double bending = 630.57, axial = 5012.27, length = 0.1;
  double error[2];
  for (const int cells : {4, 8}) {
    const auto plan = plan_of(scene({{length, 0.02, 0.02}, 0.02 / cells, 10e9, 0.2, 2500},
                                    stage("loads.fixed", {{"on", "x_min"}})));
    const double f1 = frequency(*plan->model, bending, [&](Vec3 x) {
      return Vec3{0, std::pow(x.x / length, 2), 0};
    });
    const double fa = frequency(*plan->model, axial, [&](Vec3 x) {
      return Vec3{std::sin(0.5 * std::numbers::pi * x.x / length), 0, 0};
    });
    std::printf("cantilever, %d cells high: bending %.1f Hz (%+.2f %%), axial %.1f Hz (%+.2f %%)\n",
                cells, f1, 100 * (f1 / bending - 1), fa, 100 * (fa / axial - 1));
    error[cells / 8] = std::abs(f1 / bending - 1);
    EXPECT_NEAR(fa / axial, 1, 0.02);
  }
  EXPECT_LT(error[0], 0.06);
  EXPECT_LT(error[1], 0.02);
}

// Lame's mode is exact for a free cube, because no surface is under stress.
TEST(Frequencies, OfACubesShearMode) {
  constexpr double edge = 0.1, q = std::numbers::pi / edge, exact = 9534.63;
  const auto shape = [&](Vec3 x) {
    return Vec3{std::cos(q * x.x) * std::sin(q * x.y), -std::sin(q * x.x) * std::cos(q * x.y), 0};
  };
  double error[2];
  for (const int cells : {6, 12}) {
    const auto plan = plan_of(scene({{edge, edge, edge}, edge / cells, 10e9, 0.1, 2500}));
    const double f = frequency(*plan->model, exact, shape);
    std::printf("cube of %d cells: %.1f Hz (%+.2f %%)\n", cells, f, 100 * (f / exact - 1));
    error[cells / 12] = std::abs(f / exact - 1);
  }
  EXPECT_LT(error[1], 0.01);
  EXPECT_GT(error[0] / error[1], 3);  // second order
  for (const auto& [stiffness, tolerance] : {std::pair{"bulk", 0.10}, {"eq15", 0.10}}) {
    const auto plan =
        plan_of(scene({{edge, edge, edge}, 0.01, 10e9, 0.1, 2500, "particles", stiffness}));
    const double f = frequency(*plan->model, exact, shape);
    std::printf("cube of 10 particles, %s: %.1f Hz (%+.2f %%)\n", stiffness, f,
                100 * (f / exact - 1));
    EXPECT_NEAR(f / exact, 1, tolerance);
  }
}

// The bar is ten times as long as wide. A pressure step at one end travels to the other end with
// the speed sqrt(E / rho).
TEST(WaveSpeed, OfABar) {
  constexpr double length = 0.4, speed = 2000, stress = 1e4, expected = stress / (2500 * speed);
  const auto plan =
      plan_of(scene({{length, 0.04, 0.04}, 0.004, 10e9, 0.2, 2500},
                    stage("loads.pressure", {{"on", "x_min"}, {"pressure", stress}})));
  const Model& model = *plan->model;
  Simulation simulation(model, 2);
  std::vector<double> v;
  const double step = 0.5 * model.step_limit.time_step;
  double before = 0, arrival = 0, settled = 0;
  int counted = 0;
  while (simulation.time() < 1.4 * length / speed) {
    simulation.step(step);
    simulation.velocities(v);
    double mean = 0, share = 0;
    for (Particle p = 0; p < model.body.particles; ++p)
      if (model.body.position(p).x > length - 1e-6) {
        mean += model.body.share(p) * v[3 * p];
        share += model.body.share(p);
      }
    mean /= share;
    const double now = simulation.time() - step / 2;  // time of the velocity, half a step back
    if (arrival == 0 && mean > expected) arrival = now - step * (mean - expected) / (mean - before);
    if (now > 1.15 * length / speed) {
      settled += mean;
      ++counted;
    }
    before = mean;
  }
  std::printf(
      "bar: the front arrives after %.2f us (exact 200), the free end then moves by %.3f of twice "
      "the front's speed\n",
      1e6 * arrival, settled / counted / (2 * expected));
  EXPECT_NEAR(arrival, length / speed, 0.03 * length / speed);
  EXPECT_NEAR(settled / counted, 2 * expected,
              0.03 * 2 * expected);  // a free end doubles the velocity
}

/// Angular momentum about the centre of mass, with the velocities at the middle of the step. The
/// body starts at rest in its own shape.
Vec3 spin(const Model& model, const Simulation& simulation, double step) {
  std::vector<double> u, v;
  simulation.displacements(u);
  simulation.velocities(v);
  Vec3 centre, momentum, sum;
  double mass = 0;
  for (int pass = 0; pass < 2; ++pass)
    for (Particle p = 0; p < model.body.particles; ++p) {
      const Vec3 velocity{v[3 * p], v[3 * p + 1], v[3 * p + 2]};
      const Vec3 place = model.body.position(p) + Vec3{u[3 * p], u[3 * p + 1], u[3 * p + 2]} -
                         0.5 * step * velocity;
      const double m = model.mass(p);
      if (pass == 0) {
        mass += m;
        centre = centre + m * place;
        momentum = momentum + m * velocity;
      } else {
        sum = sum + m * cross(place - (1 / mass) * centre, velocity - (1 / mass) * momentum);
      }
    }
  return sum;
}

constexpr Vec3 block_size{0.1, 0.06, 0.04};
std::string spinning(Vec3 omega, const char* boundary, const char* stiffness,
                     const Stages& more = {}) {
  return scene({block_size, 0.005, 1e9, 0.1, 1000, boundary, stiffness},
               stage("loads.start_velocity", {{"angular", omega}}) + more);
}

TEST(Spinning, StretchesABlockAsTheCentrifugalForceDoes) {
  struct Way {
    const char *boundary, *stiffness;
    /// Truth: mean strain between the outermost layers of particles, by finite elements.
    double truth, tolerance;
  };
  for (const Way& way : {Way{"particles", "bulk", 5.4014e-4, 0.12},
                         {"particles", "eq15", 5.4014e-4, 0.12},
                         {"cells", "bulk", 5.1421e-4, 0.03}}) {
    const auto plan = plan_of(spinning({0, 0, 800}, way.boundary, way.stiffness));
    const Model& model = *plan->model;
    Simulation simulation(model, 2);
    const double step = 0.5 * model.step_limit.time_step, end = 2e-3;  // ten periods along x
    const EnergyBalance start = simulation.balance();
    simulation.step(step);
    const Vec3 first = spin(model, simulation, step);
    double strain = 0, worst = 0;
    int count = 0;
    std::vector<double> u;
    while (simulation.time() < end) {
      simulation.step(step);
      simulation.displacements(u);
      Vec3 apart;
      double rest = 0;
      for (Particle p = 0; p < model.body.particles; ++p) {
        const Vec3 x = model.body.position(p);
        const double side = x.x > block_size.x - 2.6e-3 ? 1 : x.x < 2.6e-3 ? -1 : 0;
        if (side == 0) continue;
        const double weight = side * model.body.share(p);
        apart = apart + weight * (x + Vec3{u[3 * p], u[3 * p + 1], u[3 * p + 2]});
        rest += weight * x.x;
      }
      strain += norm(apart) / rest - 1;
      ++count;
      const EnergyBalance now = simulation.balance();
      worst = std::max(worst,
                       std::abs((now.kinetic + now.stored) / (start.kinetic + start.stored) - 1));
    }
    strain /= count;
    const Vec3 momentum = simulation.balance().momentum, last = spin(model, simulation, step);
    std::printf("%s, %s: mean stretch %.3e (%+.1f %%), energy departs by %.1e\n", way.boundary,
                way.stiffness, strain, 100 * (strain / way.truth - 1), worst);
    EXPECT_NEAR(strain / way.truth, 1, way.tolerance);
    EXPECT_LT(worst, 1e-5);
    EXPECT_LT(norm(momentum), 1e-13 * norm(first) / block_size.x);
    EXPECT_LT(norm(last - first), 1e-12 * norm(first));
  }
}

TEST(Spinning, AboutAnyAxisAndFalling) {
  const Vec3 omega{300, -500, 400};
  const auto free = plan_of(spinning(omega, "particles", "bulk"));
  const auto falling = plan_of(spinning(omega, "particles", "bulk",
                                        stage("loads.gravity", {{"acceleration", {0, -9.81, 0}}})));
  const double step = 0.5 * free->model->step_limit.time_step;
  Simulation one(*free->model, 1), other(*falling->model, 1);
  one.step(step);
  const Vec3 first = spin(*free->model, one, step);
  const EnergyBalance start = one.balance();
  other.step(step);
  for (int n = 0; n < 1500; ++n) {
    one.step(step);
    other.step(step);
  }
  const EnergyBalance now = one.balance();
  EXPECT_LT(norm(spin(*free->model, one, step) - first), 1e-12 * norm(first));
  EXPECT_NEAR((now.kinetic + now.stored) / (start.kinetic + start.stored), 1, 1e-5);
  EXPECT_NEAR(other.balance().stored / now.stored, 1, 1e-6);
  std::vector<double> u = displacements(one), w = displacements(other);
  double fallen = 0, turned = 0;
  for (std::size_t n = 0; n < u.size(); ++n) {
    const double expected = n % 3 == 1 ? -0.5 * 9.81 * other.time() * other.time() : 0;
    (n % 3 == 1 ? fallen : turned) =
        std::max(n % 3 == 1 ? fallen : turned, std::abs(w[n] - u[n] - expected));
  }
  EXPECT_LT(std::max(fallen, turned), 1e-11);  // m, largest of all particles
}

}  // namespace dynamics_test
