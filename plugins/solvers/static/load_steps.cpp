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
      length_(options.longest) {
  if (!options.opening) return;
  control_.emplace(problem, newton, *options.opening);
  opening_ = control_->reached();
}

bool LoadSteps::is_done() const {
  constexpr double nearly = 2e-3;  // of a step
  return share_ >= 1 || (control_ && opening_ >= options_.opening_end - nearly * options_.longest);
}

bool LoadSteps::run() {
  while (!is_done())
    if (!advance()) return false;
  return true;
}

/// Searches a state of rest at the fraction `next` of the load, or at a smaller fraction at which
/// damage has grown; with a control, at the opening `next`. `reached`: its fraction of the load.
bool LoadSteps::search(double next, double& reached) {
  if (control_) {
    found_ = control_->solve(next, length_, reached, u_);
    return found_.at_rest && !newton_.stopped();
  }
  found_ = problem_.damages
               ? cracking_.solve_load_step(next, options_.damage_step * length_ / options_.longest,
                                           reached, u_)
               : newton_.solve_load_step(next, u_);
  if (!problem_.damages) reached = next;
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
  const double start = place(), end = control_ ? options_.opening_end : 1;
  const double next = start + length_ > end - nearly * options_.longest ? end : start + length_;
  double reached = share_;
  if (!search(next, reached)) {
    length_ /= 2;
    return !newton_.stopped() && !found_.hopeless && length_ >= 0.99 * options_.shortest;
  }
  const bool may_break = options_.overshoot < infinity && length_ > options_.shortest;
  if (const double over = may_break ? problem_.overshoot(reached, u_.data()) : 0;
      over > options_.overshoot) {  // elongations are about in proportion to load and opening
    const double found = control_ ? control_->reached() : reached;
    const double wanted = found * (1 - over + options_.overshoot / 2) - start;
    length_ *= std::clamp(wanted / length_, least, most);
    go_back();
    return true;
  }
  share_ = reached;
  if (control_) opening_ = control_->reached();
  if (!host_.accept(share_, u_.data()) || !settle()) return false;
  length_ = std::min(options_.longest, 2 * length_);
  return host_.report(newton_.report()) && host_.observe();
}

/// Lets springs break under loads that are held, or that fall to where the first one breaks, or at
/// an opening that is held, until the body is at rest without them.
bool LoadSteps::settle() {
  constexpr int most_tries = 20;
  for (int tries = 0; problem_.broke > 0;) {
    newton_.forget_tangent();
    if (!search(place(), share_)) {
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
    if ((options_.snap_back || control_) && !host_.observe()) return false;
  }
  return true;
}

}  // namespace hyperlattice::equilibrium
