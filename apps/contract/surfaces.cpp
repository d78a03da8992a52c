// The contract of strength surfaces. The function: the ratio is 1 at the strength in uniaxial
// tension, grows in proportion to the stress, is convex, and no stress below the alarms of the
// springs reaches it. The body: its damage begins at the surface, only grows and only takes energy,
// with the same bits for any number of threads, after a restart, and nearly so in floats.
#include <contract/families.hpp>
#include <model/cohesive.hpp>

#include <spdlog/fmt/fmt.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace hyperlattice::contract {
namespace {

using Tensor = Eigen::Matrix3d;

/// Returns the ratios of many stresses at once.
std::vector<double> ratios(const Cohesive& of, const std::vector<PrincipalStress>& stresses) {
  std::vector<double> found(stresses.size());
  of.ratios(stresses, found.data());
  return found;
}
double ratio(const Cohesive& of, const PrincipalStress& stress) {
  return ratios(of, {stress}).front();
}

PrincipalStress scaled(const PrincipalStress& stress, double by) {
  return {by * stress.first, by * stress.second, by * stress.third};
}
PrincipalStress sorted(double a, double b, double c) {
  double values[] = {a, b, c};
  std::sort(std::begin(values), std::end(values));
  return {values[2], values[1], values[0]};
}
std::string text_of(const PrincipalStress& stress) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g}) Pa", stress.first, stress.second, stress.third);
}

/// Returns stresses of all kinds, of about the size of the strength.
std::vector<PrincipalStress> samples(const Cohesive& of) {
  constexpr std::size_t count = 1000;
  const std::vector<double> random = noise(3 * count, of.strength);
  std::vector<PrincipalStress> found;
  found.reserve(count + 7);
  for (std::size_t n = 0; n < count; ++n)
    found.push_back(sorted(random[3 * n], random[3 * n + 1], random[3 * n + 2]));
  for (const auto& [a, b, c] :
       {std::tuple(1, 0, 0), std::tuple(1, 1, 0), std::tuple(1, 1, 1), std::tuple(0, 0, -1),
        std::tuple(0, -1, -1), std::tuple(-1, -1, -1), std::tuple(1, 0, -1)})
    found.push_back(scaled(sorted(a, b, c), of.strength));
  return found;
}

Finding is_one_in_tension(const Cohesive& of) {
  const double found = ratio(of, {of.strength, 0, 0});
  return passes_if(std::abs(found - 1) < 1e-9,
                   fmt::format("{:.10g} at the strength of {:.4g} Pa", found, of.strength));
}

Finding starts_at_zero(const Cohesive& of) {
  if (const double found = ratio(of, {}); found != 0)
    return passes_if(false, fmt::format("{:.4g} without stress", found));
  for (const PrincipalStress& stress : samples(of))
    if (const double found = ratio(of, stress); !(found >= 0))
      return passes_if(false, fmt::format("{:.4g} at {}", found, text_of(stress)));
  return passes_if(true, "0 without stress, and nowhere below");
}

Finding grows_in_proportion(const Cohesive& of) {
  double worst = 0;
  for (const PrincipalStress& stress : samples(of))
    for (const double by : {1e-6, 0.5, 3.0, 1e6})
      worst = std::max(worst, std::abs(ratio(of, scaled(stress, by)) / by - ratio(of, stress)));
  return passes_if(worst < 1e-9,
                   fmt::format("n times the stress has n times the ratio to {:.1g}", worst));
}

Finding is_finite(const Cohesive& of) {
  for (const PrincipalStress& stress : samples(of))
    for (const double by : {1e-100, 1e100 / of.strength})
      if (const double found = ratio(of, scaled(stress, by)); !std::isfinite(found))
        return passes_if(false, fmt::format("{} at {}", found, text_of(scaled(stress, by))));
  return passes_if(true, "at stresses from 1e-100 times the strength to 1e100 Pa");
}

/// Two principal stresses change their order where they are equal.
Finding is_continuous(const Cohesive& of) {
  double worst = 0;
  constexpr double change = 1e-9;
  for (const PrincipalStress& stress : samples(of)) {
    const double a = stress.first, b = stress.third, off = change * of.strength;
    worst = std::max(worst, std::abs(ratio(of, {a, a, b}) - ratio(of, {a + off, a, b})));
    worst = std::max(worst, std::abs(ratio(of, {a, b, b}) - ratio(of, {a, b, b - off})));
  }
  return passes_if(worst < 1e3 * change,
                   fmt::format("where principal stresses meet it changes by {:.1g}", worst));
}

Finding is_convex(const Cohesive& of) {
  const std::vector<PrincipalStress> all = samples(of);
  for (std::size_t n = 0; n + 1 < all.size(); ++n) {
    const PrincipalStress &a = all[n], &b = all[n + 1],
                          middle{(a.first + b.first) / 2, (a.second + b.second) / 2,
                                 (a.third + b.third) / 2};
    const double mean = (ratio(of, a) + ratio(of, b)) / 2;
    if (ratio(of, middle) > mean + 1e-9 * (1 + mean))
      return passes_if(
          false, fmt::format("{} has {:.6g}, above the mean {:.6g} of the ratios of {} and {}",
                             text_of(middle), ratio(of, middle), mean, text_of(a), text_of(b)));
  }
  return passes_if(true, "the ratio of a mean of two stresses is at most the mean of their ratios");
}

PrincipalStress principal_stress(const Tensor& strain, double shear, double lame) {
  const Tensor stress = 2 * shear * strain + lame * strain.trace() * Tensor::Identity();
  const Eigen::Vector3d values =
      Eigen::SelfAdjointEigenSolver<Tensor>(stress, Eigen::EigenvaluesOnly).eigenvalues();
  return {values(2), values(1), values(0)};
}

/// Strains a particle evenly, with springs up to their alarms.
Finding alarm_is_conservative(const Model& model, const Cohesive& of) {
  constexpr std::size_t count = 20'000;
  const double most = std::min(of.shortening_alarm, 50 * of.stretch_alarm);
  const double shear = 3 * (of.modulus - of.bulk_modulus) / 4,
               lame = of.bulk_modulus - 2 * shear / 3;
  double nearest = 0;
  const std::vector<double> random = noise(6 * count, 1);
  for (std::size_t n = 0; n < count; ++n) {
    const double* e = &random[6 * n];
    Tensor strain;
    strain << e[0], e[3], e[4], e[3], e[1], e[5], e[4], e[5], e[2];
    double longest = 0, shortest = 0;
    for (const NeighbourGeometry& to : model.springs.neighbours) {
      const Eigen::Vector3d along =
          Eigen::Vector3d(to.rest.x, to.rest.y, to.rest.z) / to.rest_length;
      const double stretch = along.dot(strain * along);
      longest = std::max(longest, stretch);
      shortest = std::max(shortest, -stretch);
    }
    double by = infinity;
    if (longest > 0) by = of.stretch_alarm / longest;
    if (shortest > 0) by = std::min(by, most / shortest);
    const PrincipalStress principal = principal_stress(by * strain, shear, lame);
    nearest = std::max(nearest, ratio(of, principal));
  }
  return passes_if(nearest < 1,
                   fmt::format("springs stretched by less than {:.3g} and shortened by "
                               "less than {:.3g} have a ratio up to {:.3g}",
                               of.stretch_alarm, of.shortening_alarm, nearest));
}

/// Returns the strain of an isotropic solid under a stress with these principal values, whose
/// directions are the columns of `axes`.
Tensor strain_of(const Cohesive& of, const PrincipalStress& stress, const Tensor& axes) {
  const double shear = 3 * (of.modulus - of.bulk_modulus) / 4;
  const Eigen::Vector3d values(stress.first, stress.second, stress.third);
  const double mean = values.mean();
  const Eigen::Vector3d strains =
      (values.array() - mean) / (2 * shear) + mean / (3 * of.bulk_modulus);
  return axes * strains.asDiagonal() * axes.transpose();
}

/// Returns the least and the largest damage of the particles after the body was held in a uniform
/// strain for some steps.
std::pair<double, double> damage_in(const Model& model, const Tensor& strain) {
  const std::uint64_t particles = model.body.particles;
  std::vector<double> u(3 * particles), damage(particles);
  for (Particle p = 0; p < particles; ++p) {
    const Vec3 at = model.body.position(p);
    const Eigen::Vector3d moved = strain * Eigen::Vector3d(at.x, at.y, at.z);
    std::copy_n(moved.data(), 3, &u[3 * p]);
  }
  DrivenBody body(model);
  // The field evaluates particles far below their strength in every fourth step.
  for (int n = 0; n < 9; ++n) body.forces(u, 0.1 * model.step_limit.time_step);
  body.simulation().copy_damage(damage);
  const auto [least, most] = std::minmax_element(damage.begin(), damage.end());
  return {*least, *most};
}

/// Returns how much the ratio can change if each principal stress changes by up to `by`, Pa.
double ratio_change(const Cohesive& of, const PrincipalStress& stress, double by) {
  double most = 0;
  for (const double a : {-by, by})
    for (const double b : {-by, by})
      for (const double c : {-by, by})
        most = std::max(
            most,
            std::abs(ratio(of, sorted(stress.first + a, stress.second + b, stress.third + c)) -
                     ratio(of, stress)));
  return most;
}

/// Strains the body in proportion, along axes that are turned at random, to just below and just
/// above the surface. No particle below it is damaged, and each particle above it is, up to the
/// corners. The margin includes the second order of the strain, which the small-strain stress
/// lacks.
Finding begins_at_the_surface(const Model& model, const Cohesive& of) {
  constexpr double least_margin = 0.01, largest_margin = 0.3;
  const std::vector<PrincipalStress> all = samples(of);
  const std::vector<double> turns = noise(4 * all.size(), 1, 2);
  int paths = 0;
  for (std::size_t n = 0; n < all.size(); n += n < 950 ? 20 : 1) {
    const double to_surface = ratio(of, all[n]);
    if (!(to_surface > 0)) continue;
    const Tensor axes = Eigen::Quaterniond(Eigen::Vector4d(&turns[4 * n])).normalized().matrix();
    const Tensor strain = strain_of(of, all[n], axes) / to_surface;
    const double margin = least_margin + ratio_change(of, scaled(all[n], 1 / to_surface),
                                                      3 * of.modulus * strain.squaredNorm());
    if (margin > largest_margin) continue;
    ++paths;
    const auto where = [&] {
      return fmt::format("{:.0f} % from {}", 100 * margin, text_of(scaled(all[n], 1 / to_surface)));
    };
    if (damage_in(model, (1 - margin) * strain).second != 0)
      return passes_if(false, "damage inside, " + where());
    if (!(damage_in(model, (1 + margin) * strain).first > 0))
      return passes_if(false, "particles without damage outside, " + where());
  }
  return passes_if(
      paths > 20, fmt::format("on {} paths in all directions, up to the corners of a body", paths));
}

/// Returns a motion whose springs pass their alarms within a step.
RandomMotion shaking(const Model& model, const Cohesive& of) {
  return {3 * of.stretch_alarm * model.body.grid.spacing / model.step_limit.time_step};
}

/// A spring that passes through its rest length within a step has a negative product u_n u_n+1 in
/// the dissipated energy (docs/theory/cohesive.md). So the sum may fall by a little, which vanishes
/// with the step.
Finding only_takes_energy(const Model& model, const Cohesive& of) {
  Simulation simulation(model, 1);
  simulation.set_velocities(noise(3 * model.body.particles, shaking(model, of).speed), {});
  std::vector<double> before(model.body.particles, 0), now = before;
  double taken = 0, fallen_back = 0;
  for (int n = 0; n < 400; ++n) {
    simulation.step(0.1 * model.step_limit.time_step);
    simulation.copy_damage(now);
    const double dissipated = simulation.balance().dissipated_failure;
    for (std::size_t p = 0; p < now.size(); ++p)
      if (now[p] < before[p])
        return passes_if(false, fmt::format("damage {} becomes {}", before[p], now[p]));
    fallen_back = std::max(fallen_back, taken - dissipated);
    before = now;
    taken = std::max(taken, dissipated);
  }
  const EnergyBalance balance = simulation.balance();
  return passes_if(
      taken > 0 && fallen_back < 1e-3 * taken && std::abs(balance.relative_error()) < 1e-3,
      fmt::format("{:.3g} J in 400 steps, falls by at most {:.1g} of it; balance {:.1g}", taken,
                  fallen_back / taken, balance.relative_error()));
}

Finding in_floats(const Model& doubles, const Model& floats, const Cohesive& of) {
  const double exact = run_motion(doubles, shaking(doubles, of)).balance.dissipated_failure,
               rounded = run_motion(floats, shaking(doubles, of)).balance.dissipated_failure;
  return passes_if(
      std::abs(rounded / exact - 1) < 1e-3,
      fmt::format("damage takes the same energy within {:.1g}", std::abs(rounded / exact - 1)));
}

}  // namespace

void check_surface(Trial& trial) {
  Json material = trial.scenes.material();
  material["failure"] = trial.example;
  const std::vector<Json> stages{trial.scenes.grid_box(4, 4, 4, "cells"), material};
  const auto plan = trial.scenes.plan_of(stages);
  const Cohesive& of = plan->model->cohesive.front();
  trial.check("1 in tension", [&] { return is_one_in_tension(of); });
  trial.check("0 without stress", [&] { return starts_at_zero(of); });
  trial.check("in proportion", [&] { return grows_in_proportion(of); });
  trial.check("finite", [&] { return is_finite(of); });
  trial.check("continuous", [&] { return is_continuous(of); });
  trial.check("convex", [&] { return is_convex(of); });
  const Model& model = *plan->model;
  trial.check("alarm is conservative", [&] { return alarm_is_conservative(model, of); });
  trial.check("begins at the surface", [&] { return begins_at_the_surface(model, of); });
  const RandomMotion motion = shaking(model, of);
  trial.check("only takes energy", [&] { return only_takes_energy(model, of); });
  trial.check("same bits", [&] { return same_bits_while_failing(model, motion); });
  trial.check("restart", [&] { return restart_while_failing(model, motion); });
  trial.check("in floats", [&] {
    const auto floats = trial.scenes.plan_of(stages, 1, "float");
    return in_floats(model, *floats->model, of);
  });
}

}  // namespace hyperlattice::contract
