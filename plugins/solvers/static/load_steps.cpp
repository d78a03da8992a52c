#include "load_steps.hpp"

#include <algorithm>

namespace hyperlattice::equilibrium {

LoadSteps::LoadSteps(const StaticProblem& problem, const SolverHost& host, Newton& newton,
                     const LoadStepOptions& options)
    : problem_(problem),
      host_(host),
      newton_(newton),
      options_(options),
      cracking_(problem, newton, options.snap_back),
      u_(problem.state, problem.state + problem.grid.numbers()),
      length_(options.longest) {}

bool LoadSteps::run() {
  while (share_ < 1)
    if (!advance()) return false;
  return true;
}

/// Searches a state of rest at `most_share`, or at a smaller fraction at which damage has grown.
bool LoadSteps::search(double most_share, double& reached) {
  found_ = problem_.damages
               ? cracking_.solve_load_step(
                     most_share, options_.damage_step * length_ / options_.longest, reached, u_)
               : newton_.solve_load_step(most_share, u_);
  if (!problem_.damages) reached = most_share;
  return found_.at_rest && !newton_.stopped();
}

/// Returns to the last accepted state.
void LoadSteps::go_back() {
  std::copy_n(problem_.state, u_.size(), u_.begin());
  newton_.forget_tangent();
  if (problem_.damages) problem_.restore_damage();
}

/// Makes a step, or cuts it. Returns false if the stage must end.
bool LoadSteps::advance() {
  constexpr double nearly = 1e-9, least = 0.1, most = 0.9;
  const double next = share_ + length_ > 1 - nearly ? 1 : share_ + length_;
  double reached = share_;
  if (!search(next, reached)) {
    length_ /= 2;
    return !newton_.stopped() && !found_.hopeless && length_ >= 0.99 * options_.shortest;
  }
  const bool may_break = options_.overshoot < infinity && length_ > options_.shortest;
  if (const double over = may_break ? problem_.overshoot(reached, u_.data()) : 0;
      over > options_.overshoot) {  // elongations are about in proportion to the load
    const double wanted = reached * (1 - over + options_.overshoot / 2) - share_;
    length_ *= std::clamp(wanted / length_, least, most);
    go_back();
    return true;
  }
  share_ = reached;
  if (!host_.accept(share_, u_.data()) || !settle()) return false;
  length_ = std::min(options_.longest, 2 * length_);
  return host_.report(newton_.report()) && host_.observe();
}

/// Lets springs break under loads that are held, or that fall to where the first one breaks, until
/// the body is at rest without them.
bool LoadSteps::settle() {
  constexpr int most_tries = 20;
  for (int tries = 0; problem_.broke > 0;) {
    newton_.forget_tangent();
    if (!search(share_, share_)) {
      host_.observe();  // records what broke, though the body is not at rest
      return false;
    }
    const bool may_fall = options_.snap_back && tries < most_tries;
    if (const double over = may_fall ? problem_.overshoot(share_, u_.data()) : 0;
        over > options_.overshoot) {
      share_ *= 1 - over + options_.overshoot / 2;
      ++tries;
      go_back();
      continue;
    }
    tries = 0;
    if (!host_.accept(share_, u_.data())) return false;
    if (options_.snap_back && !host_.observe()) return false;
  }
  return true;
}

}  // namespace hyperlattice::equilibrium
