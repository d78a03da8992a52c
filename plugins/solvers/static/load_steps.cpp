#include "load_steps.hpp"

#include <equilibrium/search_memory.hpp>

#include <algorithm>
#include <stdexcept>

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
  if (resumed_ && was_shown_ && !host_.observe()) return false;
  if (resumed_ && !complete()) return false;
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

/// Makes the state of rest that was found the present one, and keeps what the way from there
/// depends on. `settles`: it follows a state in which springs broke. Returns false if the run must
/// stop.
bool LoadSteps::accept(bool settles) {
  const bool goes_on = host_.accept(share_, u_.data());
  const bool is_shown = settles && (options_.snap_back || control_);
  std::vector<double> all{share_,
                          opening_,
                          length_,
                          cracking_.has_cracked() ? 1.0 : 0.0,
                          control_ ? control_->start() : 0,
                          control_ ? control_->reached() : 0,
                          is_shown ? 1.0 : 0.0};
  remember(newton_, all);
  host_.keep(all);
  return goes_on && (!is_shown || host_.observe());
}

void LoadSteps::recall(std::span<const double> kept) {
  constexpr std::size_t own = 7;
  if (kept.size() < own) throw std::runtime_error("the checkpoint is of another solver");
  share_ = kept[0];
  opening_ = kept[1];
  length_ = kept[2];
  cracking_.set_cracked(kept[3] > 0);
  if (control_) control_->recall(kept[4], kept[5]);
  was_shown_ = kept[6] > 0;
  resumed_ = true;
  equilibrium::recall(kept.subspan(own), newton_);
}

/// Makes a step, or cuts it. Returns false if the stage must end.
bool LoadSteps::advance() {
  constexpr double nearly = 1e-9, least = 0.1, most = 0.9;
  const double start = place(), end = control_ ? options_.opening_end : 1;
  const double next = start + length_ > end - nearly * options_.longest ? end : start + length_;
  double reached = share_;
  newton_.forget_tangent();  // a run that is resumed here has none
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
  return accept(false) && complete();
}

/// Ends a step whose state was accepted. Returns false if the run must stop.
bool LoadSteps::complete() {
  if (!settle()) return false;
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
      // Records what broke, though the body is not at rest; a run that is resumed searches again.
      if (!newton_.stopped()) host_.observe();
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
    if (!accept(true)) return false;
  }
  return true;
}

}  // namespace hyperlattice::equilibrium
