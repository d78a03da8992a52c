#include "opening_control.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace hyperlattice::equilibrium {

namespace {

constexpr double least_share = 1e-9, first_share = 0.01;  // of the load
constexpr double near_enough = 1e-3;                      // of a step of the opening

}  // namespace

OpeningControl::OpeningControl(const StaticProblem& problem, Newton& newton,
                               const Opening::Ends& ends)
    : problem_(problem), newton_(newton), opening_(problem, ends) {
  start_ = reached_ = opening_.of(Field(problem.state, problem.state + problem.grid.numbers()));
}

/// Brings the body to rest under this fraction of the load, or under a smaller one if there is no
/// rest: without springs that broke, or with more damage, it may carry less.
Outcome OpeningControl::rest_at(double& share, bool precise, Field& displacement) {
  constexpr int tries = 6;
  constexpr double rough = 1e-4;  // residual while damage or the load still changes
  const double tolerance = newton_.tolerance();
  Outcome found;
  for (int n = 0; n < tries; ++n) {
    newton_.forget_tangent();
    newton_.set_tolerance(precise ? tolerance : std::max(tolerance, rough));
    found = newton_.solve_load_step(share, displacement);
    newton_.set_tolerance(tolerance);
    if (found.at_rest || precise || newton_.stopped()) break;
    share /= 2;
  }
  return found;
}

/// Returns the fraction of the load at which the opening is as wanted, by a secant from the state
/// before, with the same springs and damage, or from the start of the stage. Returns NaN if the
/// opening does not grow with the load.
double OpeningControl::next_share(const Point& now, const Point* before, double wanted) const {
  constexpr double most = 4;  // times the present fraction
  const Point from = before != nullptr && before->share != now.share ? *before : Point{0, start_};
  const double slope = (now.opening - from.opening) / (now.share - from.share);
  if (!(slope > 0)) return std::nan("");
  return std::clamp(now.share + (wanted - now.opening) / slope,
                    std::max(least_share, now.share / most),
                    std::min(1.0, std::max(most * now.share, 2 * first_share)));
}

Outcome OpeningControl::solve(double wanted, double step, double& share, Field& displacement) {
  constexpr int most_alternations = 1000;
  constexpr double still = 1e-4;  // changes of damage
  Field u = displacement;
  double at = share > 0 ? share : first_share;
  std::optional<Point> before;
  bool settled = false;
  for (int n = 0; n < most_alternations; ++n) {
    const Outcome found = rest_at(at, settled, u);
    if (newton_.stopped()) return {};
    if (!found.at_rest) {
      if (problem_.damages) problem_.restore_damage();
      return found;
    }
    const Point now{at, opening_.of(u)};
    if (settled) {
      share = at;
      displacement = u;
      reached_ = now.opening;
      return found;
    }
    const double next = next_share(now, before ? &*before : nullptr, wanted);
    if (!(next > 0)) {
      if (problem_.damages) problem_.restore_damage();
      return {.why = "the opening from `opening_from` to `opening_to` does not grow with the load"};
    }
    const bool is_near = std::abs(now.opening - wanted) <= near_enough * step ||
                         (now.opening < wanted && at == 1 && next == 1);
    double change = 0;
    if (problem_.damages)
      change = problem_.grow_damage(u.data(), {now.share, next, next, 1}).change;
    else
      before = now;
    settled = is_near && change <= still;
    if (!settled || problem_.damages) at = next;
  }
  if (problem_.damages) problem_.restore_damage();
  return {.why = problem_.damages ? "its damage does not come to rest"
                                  : "no load gives the opening that is wanted"};
}

}  // namespace hyperlattice::equilibrium
