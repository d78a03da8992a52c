#include "cracking.hpp"

#include <algorithm>
#include <cmath>

namespace hyperlattice::equilibrium {

Outcome Cracking::solve_load_step(double most_share, double most_growth, double& share,
                                  Field& displacement) {
  constexpr int most_alternations = 1000;
  constexpr double still = 1e-4;         // changes of damage, and of the load over itself
  constexpr double rough = 1e-4;         // residual while damage still changes
  constexpr double first_growth = 0.02;  // of a step: the first damage ends a step at the peak
  const double tolerance = newton_.tolerance();
  const double least_share = follows_ ? 0 : share;
  const double growth = cracked_ ? most_growth : first_growth * most_growth;
  Field u = displacement;
  constexpr double least_part = 0.01;  // of the load, from which stresses are scaled
  double at = cracked_ && share > least_part * most_share ? share : most_share;
  bool settled = false;
  for (int n = 0; n < most_alternations; ++n) {
    newton_.forget_tangent();
    newton_.set_tolerance(settled ? tolerance : std::max(tolerance, rough));
    Outcome found = newton_.solve_load_step(at, u);
    newton_.set_tolerance(tolerance);
    if (newton_.stopped()) return {};
    if (settled && found.at_rest) {
      cracked_ = cracked_ || at < most_share;
      share = at;
      displacement = u;
    }
    if (settled || !found.at_rest) {
      if (!found.at_rest) problem_.restore_damage();
      return found;
    }
    const DamageFound damage =
        problem_.grow_damage(u.data(), {at, least_share, most_share, growth});
    settled = damage.change <= still && std::abs(damage.share - at) <= still * most_share;
    at = damage.share;
  }
  problem_.restore_damage();
  return {.why = "its damage does not come to rest"};
}

}  // namespace hyperlattice::equilibrium
