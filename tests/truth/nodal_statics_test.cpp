// States of rest and sections of lists with nodal volumes: the exact tangent, relaxation, energy,
// the Poisson ratio of finite bodies, the force through a plane at rest and while it opens.
#include <equilibrium/listed_system.hpp>
#include <model/homogenise.hpp>
#include <model/section.hpp>
#include <statics/statics.hpp>
#include <support/lists.hpp>
#include <support/rest.hpp>

#include <gtest/gtest.h>

#include <cstdio>
#include <numeric>

namespace nodal_statics_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

/// The assembled tangent without a preconditioner.
struct Tangent : equilibrium::ListedSystem {
  using ListedSystem::ListedSystem;
  void prepare() override {}
  void apply(const equilibrium::Field& r, equilibrium::Field& z) override { z = r; }
};

std::string random_scene(int n, double poisson, const Keys& lattice, const Stages& stages,
                         const Keys& material = {}) {
  return SceneBuilder{}
      .stages(random_lattice(n, n, n, Keys{{"sample", 8}} + lattice))
      .material("materials.elastic",
                Keys{{"density", 2500}, {"young", 1e10}, {"poisson", poisson}} + material)
      .stages(stages)
      .text();
}

/// The product with the tangent is the derivative of the forces, at displacements of a tenth of a
/// spacing, with pressures as large as K_v.
TEST(NodalStatics, TheTangentIsTheDerivativeOfTheForces) {
  for (const double poisson : {0.4, 0.49}) {
    const auto plan =
        plan_of(listed_scene(random_lattice(6, 6, 6, {{"sample", 8}}), {{"poisson", poisson}}));
    Simulation simulation(*plan->model, 1);
    const Statics body(*plan->model, simulation, Statics::Search::rest, 0, 1, 1);
    const StaticProblem& problem = body.problem();
    Tangent tangent(problem);
    const std::size_t numbers = problem.grid.numbers();
    const auto field = [&](double size, unsigned seed) {
      const std::vector<double> rough = noise(numbers, size, seed);
      return equilibrium::Field(rough.begin(), rough.end());
    };
    const equilibrium::Field u = field(1e-4, 1), v = field(1e-4, 2);
    equilibrium::Field force(numbers), product(numbers);
    const double energy = tangent.linearise(u, force);
    tangent.multiply(v.data(), product.data());
    const auto force_at = [&](double share) {
      equilibrium::Field moved = u, found(numbers);
      for (std::size_t n = 0; n < numbers; ++n) moved[n] += share * v[n];
      problem.respond(moved.data(), found.data(), nullptr);
      return found;
    };
    constexpr double h = 1e-3;
    const equilibrium::Field a = force_at(h), b = force_at(-h), c = force_at(2 * h),
                             d = force_at(-2 * h);
    double worst = 0;
    for (std::size_t n = 0; n < numbers; ++n)
      worst =
          std::max(worst, std::abs(product[n] + (8 * (a[n] - b[n]) - (c[n] - d[n])) / (12 * h)));
    const double size = equilibrium::largest(product);
    EXPECT_GT(energy, 0);
    EXPECT_LT(worst, 1e-6 * size) << poisson;
    std::printf("nu %g: tangent against differences %.1e\n", poisson, worst / size);
  }
}

Stages pulled(double displacement) {
  return stage("loads.fixed", {{"on", "z_min"}}) +
         stage("loads.displacement",
               {{"on", "z_max"}, {"value", Vec3{0, 0, displacement}}, {"rise", 1e-3}});
}

TEST(NodalStatics, RelaxationAgrees) {
  for (const char* coordination : {"8.4", "13.2"})
    for (const double poisson : {0.3, 0.45}) {
      const auto body = [&](const Stages& solver) {
        return random_scene(7, poisson, Keys{{"coordination", std::stod(coordination)}},
                            pulled(7e-6) + solver);
      };
      const AtRest relaxed(body(stage("solvers.relaxation", {{"tolerance", 1e-8}})));
      for (const char* preconditioner : {"whole", "incomplete", "multigrid"}) {
        const AtRest found(body(
            stage("solvers.static", {{"tolerance", 1e-8}, {"preconditioner", preconditioner}})));
        const double error = distance(found.u, relaxed.u) / largest(found.u);
        EXPECT_LT(error, 1e-5) << poisson;
        std::printf("%s, nu %g, %s: %llu iterations, relaxation %llu steps, difference %.1e\n",
                    coordination, poisson, preconditioner,
                    static_cast<unsigned long long>(found.report.iterations),
                    static_cast<unsigned long long>(relaxed.report.iterations), error);
      }
    }
}

/// The energy is that of the steps in time, and the supports carry the load.
TEST(NodalStatics, EnergyIsTheWorkAndReactionsAreTheLoad) {
  const Vec3 total{1, 0, 5};
  const Keys load = {{"on", "z_max"}, {"total", total}};
  const AtRest body(random_scene(7, 0.45, {},
                                 stage("loads.fixed", {{"on", "z_min"}}) +
                                     stage("loads.force", load) +
                                     stage("solvers.static", {{"tolerance", 1e-11}})));
  const EnergyBalance balance = body.simulation->balance();
  EXPECT_GT(balance.stored, 0);
  EXPECT_NEAR(balance.injected / balance.stored, 1, 1e-4);
  const Vec3 on_support = body.simulation->force_on_load().front();
  EXPECT_LT(norm(on_support - total), 1e-9);
}

/// The mean strain along an axis: the slope of the displacements over the places of the particles
/// that are at least `inside` from the sides of a cube with this edge, m.
double mean_strain(const AtRest& body, std::size_t axis, double edge, double inside) {
  double count = 0, place = 0, moved = 0, both = 0, square = 0;
  for (Particle p = 0; p < body.model().body.particles; ++p) {
    const Vec3 x = body.model().body.position(p);
    if (std::min({x.x, x.y, x.z}) < inside || std::max({x.x, x.y, x.z}) > edge - inside) continue;
    const double u = body.u[3 * p + axis];
    ++count;
    place += x[axis];
    moved += u;
    both += x[axis] * u;
    square += x[axis] * x[axis];
  }
  return (both - place * moved / count) / (square - place * place / count);
}

double poisson_of(const AtRest& body, double edge, double inside) {
  return -(mean_strain(body, 0, edge, inside) + mean_strain(body, 1, edge, inside)) / 2 /
         mean_strain(body, 2, edge, inside);
}

/// The soft surface of a finite body lowers its Poisson ratio; the sample has the one asked for.
TEST(NodalStatics, FiniteBodiesAreNearTheRatioOfTheSample) {
  for (const double coordination : {8.4, 13.2})
    for (const int n : {8, 14}) {
      const double edge = n * 1e-3, half = 0.5e-4 * edge;
      const auto platen = [&](const char* on, double displacement) {
        return stage(
            "loads.displacement",
            {{"on", on}, {"axes", "z"}, {"value", Vec3{0, 0, displacement}}, {"rise", 1e-3}});
      };
      const AtRest body(
          random_scene(n, 0.45, {{"coordination", coordination}, {"sample", 12}},
                       platen("z_min", -half) + platen("z_max", half) + stage("solvers.static")));
      const Model& model = body.model();
      const double sample = homogenise(model.body.listed, 0, model.body.grid.membrane_distance,
                                       model.materials[0].constants)
                                .poisson(),
                   whole = poisson_of(body, edge, 0), middle = poisson_of(body, edge, 0.25 * edge);
      std::printf("%d^3, %g neighbours: sample %.4f, body %.4f, its middle %.4f; %llu iterations\n",
                  n, coordination, sample, whole, middle,
                  static_cast<unsigned long long>(body.report.iterations));
      EXPECT_NEAR(sample, 0.45, 1e-5);
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

/// At rest a section carries the loads beyond it, less what the solver left out of balance there.
TEST(NodalSections, BalanceAtRest) {
  const AtRest body(
      random_scene(7, 0.45, {},
                   stage("loads.fixed", {{"on", "z_min"}}) +
                       stage("loads.force", {{"on", "z_max"}, {"total", Vec3{3, -2, 20}}}) +
                       stage("loads.gravity", {{"acceleration", Vec3{100, 0, -9.81}}}) +
                       stage("solvers.static", {{"tolerance", 1e-12}})));
  ForceSums& sums = body.simulation->force_sums();
  for (const Vec3 normal : {Vec3{0, 0, 1}, Vec3{0.3, -0.5, 0.9}, Vec3{1, 1, 0}}) {
    const Vec3 point{3.5e-3, 3.4e-3, 3.6e-3};
    const ForcesId external = sums.follow(beyond(body.model(), point, normal)),
                   through = sums.follow(cut(body.model(), point, normal, all_of(body.model())));
    sums.measure();
    const Vec3 apart = sums.sum(through, {}).force - sums.sum(external, {}).force,
               left = OutOfBalance(body).on(beyond(body.model(), point, normal), {}).force;
    EXPECT_LT(norm(left), 1e-10);
    EXPECT_LT(norm(apart + left), 1e-12);
    EXPECT_GT(norm(sums.sum(through, {}).force), 0.1);
  }
}

/// While springs break on a plane, and after all have broken, the force through it is the change of
/// the momentum beyond. The opened plane carries less than a hundredth: some tetrahedra reach
/// across it with edges that are no springs, from particles of which no spring has broken.
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
  EXPECT_LT(norm(force), 0.01 * most);
}

}  // namespace nodal_statics_test
