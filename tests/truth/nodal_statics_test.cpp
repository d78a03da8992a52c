// Nodal volumes of lists: the tangent that the static solver assembles, and the force through a
// plane that opens.
#include <listed_system.hpp>
#include <model/section.hpp>
#include <state/force_sums.hpp>
#include <statics/statics.hpp>
#include <support/lists.hpp>

#include <gtest/gtest.h>

#include <cstdio>
#include <numeric>

namespace {
using namespace hyperlattice;
using namespace hyperlattice::test;

/// The assembled tangent without a preconditioner.
struct Tangent : statics::ListedSystem {
  using ListedSystem::ListedSystem;
  void prepare() override {}
  void apply(const statics::Field& r, statics::Field& z) override { z = r; }
};

/// The product with the tangent is the derivative of the forces, at displacements of a tenth of a
/// spacing, with pressures as large as K_v.
TEST(NodalStatics, TheTangentIsTheDerivativeOfTheForces) {
  for (const double poisson : {0.4, 0.49}) {
    const auto plan =
        plan_of(listed_scene(random_lattice(6, 6, 6, {{"sample", 8}}), {{"poisson", poisson}}));
    Simulation simulation(*plan->model, 1);
    const Statics body(*plan->model, simulation, 0, 1, 1);
    const StaticProblem& problem = body.problem();
    Tangent tangent(problem);
    const std::size_t numbers = problem.grid.numbers();
    const auto field = [&](double size, unsigned seed) {
      const std::vector<double> rough = noise(numbers, size, seed);
      return statics::Field(rough.begin(), rough.end());
    };
    const statics::Field u = field(1e-4, 1), v = field(1e-4, 2);
    statics::Field force(numbers), product(numbers);
    const double energy = tangent.linearise(u, force);
    tangent.multiply(v.data(), product.data());
    const auto force_at = [&](double share) {
      statics::Field moved = u, found(numbers);
      for (std::size_t n = 0; n < numbers; ++n) moved[n] += share * v[n];
      problem.respond(moved.data(), found.data(), nullptr);
      return found;
    };
    constexpr double h = 1e-3;
    const statics::Field a = force_at(h), b = force_at(-h), c = force_at(2 * h),
                         d = force_at(-2 * h);
    double worst = 0;
    for (std::size_t n = 0; n < numbers; ++n)
      worst =
          std::max(worst, std::abs(product[n] + (8 * (a[n] - b[n]) - (c[n] - d[n])) / (12 * h)));
    const double size = statics::largest(product);
    EXPECT_GT(energy, 0);
    EXPECT_LT(worst, 1e-6 * size) << poisson;
    std::printf("nu %g: tangent against differences %.1e\n", poisson, worst / size);
  }
}

std::vector<Particle> all_of(const Model& model) {
  std::vector<Particle> all(model.body.particles);
  std::iota(all.begin(), all.end(), Particle{0});
  return all;
}

/// The particles beyond the plane through `point`.
std::vector<Particle> beyond(const Model& model, Vec3 point, Vec3 normal) {
  std::vector<Particle> found;
  for (Particle p = 0; p < model.body.particles; ++p)
    if (dot(model.body.position(p) - point, normal) > 1e-9 * model.body.grid.spacing * norm(normal))
      found.push_back(p);
  return found;
}

/// While springs break on a plane, and after all have broken, the force through it is the change of
/// the momentum beyond; the opened plane carries nothing.
TEST(NodalSections, BalanceWhileAPlaneOpens) {
  const auto plan = plan_of(listed_scene(
      random_lattice(6, 6, 8, {{"sample", 8}}),
      {{"poisson", 0.45}, {"failure", {{"type", "failures.elongation"}, {"limit", 3e-5}}}}));
  const Model& model = *plan->model;
  Simulation simulation(model, 2);
  const Vec3 point{3e-3, 3e-3, 4e-3}, normal{0, 0, 1};
  const std::vector<Particle> upper = beyond(model, point, normal);
  std::vector<double> velocities(3 * model.body.particles, 0.0);
  for (Particle p = 0; p < model.body.particles; ++p) velocities[3 * p + 2] = -100;
  for (const Particle p : upper) velocities[3 * p + 2] = 100;
  simulation.set_velocities(velocities, {});
  const ForcesId through = simulation.force_sums().follow(cut(model, point, normal, all_of(model)));
  const auto momentum = [&] {
    simulation.velocities(velocities);
    Vec3 sum;
    for (const Particle p : upper)
      sum += model.mass(p) * Vec3{velocities[3 * p], velocities[3 * p + 1], velocities[3 * p + 2]};
    return sum;
  };
  const double dt = 0.5 * model.step_limit.time_step;
  double most = 0, worst = 0;
  Vec3 force;
  simulation.step(dt);
  for (int n = 0; n < 200; ++n) {
    simulation.force_sums().measure();
    force = simulation.force_sums().sum(through, {}).force;
    most = std::max(most, norm(force));
    const Vec3 before = momentum();
    simulation.step(dt);
    worst = std::max(worst, norm((momentum() - before) / dt + force));
  }
  EXPECT_GT(simulation.broken(), 50U);
  EXPECT_LT(worst, 1e-11 * most);
  std::printf("force %.3g N at most, %.3g N through the opened plane, balance %.1e N\n", most,
              norm(force), worst);
  EXPECT_EQ(norm(force), 0);
}

}  // namespace
