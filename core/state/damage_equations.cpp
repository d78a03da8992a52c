#include <state/damage_equations.hpp>
#include <state/damage_growth.hpp>

#include <algorithm>
#include <cmath>

namespace hyperlattice {

double DamageEquations::solve(double factor) {
  constexpr double over_relaxation = 1.7, solved = 1e-7;
  constexpr int most_sweeps = 2000;
  double growth = 0;
  for (int n = 0; n < most_sweeps; ++n) {
    double change = 0;
    growth = 0;
    for (const Equation& equation : all_) {
      double& damage = damage_[equation.record];
      double others = 0;
      for (std::size_t o = equation.first; o < equation.last; ++o)
        others += others_[o].weight * damage_[others_[o].record];
      // The rate of a step of length 1 with this viscosity is the growth at rest.
      DamageStep step;
      step.damage = equation.start;
      step.rate = damage - equation.start;
      step.shape = equation.shape;
      step.drive = factor * factor * equation.drive;
      step.spread = others - equation.diagonal * equation.start;
      step.viscosity = equation.diagonal;
      step.time_step = 1;
      const double target = equation.start + damage_rate(step),
                   next = std::clamp(damage + over_relaxation * (target - damage), equation.start,
                                     1.0);
      change = std::max(change, std::abs(next - damage));
      damage = next;
      growth = std::max(growth, damage - equation.start);
    }
    if (change < solved) break;
  }
  return growth;
}

double DamageEquations::solve(const DamageBounds& bounds) {
  constexpr double nearly = 1e-4;
  constexpr int tries = 60;
  struct End {
    double factor;
    double excess;  ///< of growth over the wanted one, relative
    bool known = false;
  } low{bounds.least_factor, -1}, high{bounds.most_factor, 1};
  // d = 1 solves the equations under any load. So a search that has gone too far goes on from the
  // damage below it: from there growth is the least.
  std::vector<double> below(all_.size());
  for (std::size_t n = 0; n < all_.size(); ++n) below[n] = all_[n].start;
  bool from_below = false;
  // At rest the factor is 1.
  double factor = std::clamp(1.0, low.factor, high.factor), step = 0.01;
  for (int n = 0; n < tries; ++n) {
    double excess = solve(factor) / bounds.most_growth - 1;
    if (excess > nearly && !from_below) {
      from_below = true;
      for (std::size_t e = 0; e < all_.size(); ++e) damage_[all_[e].record] = below[e];
      excess = solve(factor) / bounds.most_growth - 1;
    }
    if (std::abs(excess) < nearly || (excess < 0 && factor >= high.factor) ||
        (excess > 0 && factor <= low.factor))
      return factor;
    (excess < 0 ? low : high) = {factor, excess, true};
    for (std::size_t e = 0; e < all_.size(); ++e) {
      double& damage = damage_[all_[e].record];
      (excess < 0 ? below[e] : damage) = excess < 0 ? damage : below[e];
    }
    if (low.known && high.known) {  // a secant, or halves where nothing grows at the lower end
      const double part =
          low.excess > -1 ? std::clamp(low.excess / (low.excess - high.excess), 0.02, 0.98) : 0.5;
      factor = low.factor + part * (high.factor - low.factor);
    } else {
      factor = std::clamp(factor * (excess < 0 ? 1 + step : 1 - step), low.factor, high.factor);
      step = std::min(4 * step, 0.5);
    }
  }
  return factor;
}

}  // namespace hyperlattice
