// The contract of strength surfaces: the ratio is 1 at the strength in uniaxial tension, grows in
// proportion to the stress, is convex, and no stress below the alarms of the springs reaches it.
#include <contract/families.hpp>
#include <model/cohesive.hpp>

#include <spdlog/fmt/fmt.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace hyperlattice::contract {
namespace {

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

using Tensor = Eigen::Matrix3d;

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

}  // namespace

void check_surface(Trial& trial) {
  Json material = trial.scenes.material();
  material["failure"] = trial.example;
  const auto plan = trial.scenes.plan_of({trial.scenes.grid_box(4, 4, 4, "cells"), material});
  const Cohesive& of = plan->model->cohesive.front();
  trial.check("1 in tension", [&] { return is_one_in_tension(of); });
  trial.check("0 without stress", [&] { return starts_at_zero(of); });
  trial.check("in proportion", [&] { return grows_in_proportion(of); });
  trial.check("finite", [&] { return is_finite(of); });
  trial.check("continuous", [&] { return is_continuous(of); });
  trial.check("convex", [&] { return is_convex(of); });
  trial.check("alarm is conservative", [&] { return alarm_is_conservative(*plan->model, of); });
}

}  // namespace hyperlattice::contract
