#include <equilibrium/newton.hpp>

#include <equilibrium/free_motions.hpp>
#include <equilibrium/height_change.hpp>
#include <equilibrium/stability.hpp>

#include <limits>
#include <utility>

namespace hyperlattice::equilibrium {

Newton::Newton(System& system, const SolverHost& host, const Limits& limits)
    : system_(system),
      problem_(system.problem()),
      host_(host),
      limits_(limits),
      gradients_(system, system) {
  for (Field* field : {&external_, &force_, &trial_, &rest_, &right_, &held_part_})
    field->assign(system.numbers(), 0);
}

Outcome Newton::solve_load_step(double share, Field& displacement) {
  Outcome found;
  for (const bool careful : {false, true}) {
    careful_ = careful;
    found = iterate(share, displacement);
    if (found.at_rest || stopped_) break;
    if (!careful && problem_.grid.tears) {
      found.at_rest = iterate_held(share, displacement);
      if (found.at_rest || stopped_) break;
    }
    if (found.hopeless || found.buckles) break;
  }
  return found;
}

/// Searches with a stiffness against every motion in the tangent, K + hold, which falls as far as
/// the tangent allows. Pieces that hang on too few springs, or that buckle aside, so come to their
/// own rest in small steps. The forces are the true ones. Returns whether the body came to rest.
bool Newton::iterate_held(double share, Field& displacement) {
  constexpr int most_steps = 200;
  constexpr double first = 1e-2, least = 1e-6, most = 1;  // of the stiffest spring
  Field u = displacement;
  const Field none(u.size(), 0);
  careful_ = true;
  problem_.load(share, external_.data());
  problem_.prescribe(share, u.data());
  double part = first;
  bool at_rest = false;
  for (int n = 0; n < most_steps && !at_rest && !stopped_; ++n) {
    problem_.hold(part * system_.stiffest());
    prepared_ = false;
    const StepResult result = step(none, u);
    at_rest = result == StepResult::converged;
    stopped_ = result == StepResult::cancelled;
    // Residuals may rise while pieces move far to their rest.
    part = result == StepResult::reduced_residual ? std::max(part / 2, least)
                                                  : std::min(4 * part, most);
  }
  problem_.hold(0);
  prepared_ = false;
  if (at_rest) displacement = u;
  return at_rest;
}

Outcome Newton::iterate(double share, Field& displacement) {
  Field u = displacement;
  problem_.load(share, external_.data());
  Field change = u;  // change of the prescribed displacements
  problem_.prescribe(share, change.data());
  for (std::size_t n = 0; n < change.size(); ++n) change[n] -= u[n];

  for (int n = 0; n < limits_.newton; ++n) {
    switch (step(change, u)) {
      case StepResult::converged: {
        const bool linear = n == 0 && largest(displacement) == 0 &&
                            !may_wrinkle(u);  // the tangent of the undeformed body is still valid
        Outcome found = limits_.stable && !linear ? check_stability(u) : Outcome{.at_rest = true};
        if (found.at_rest) displacement = u;
        return found;
      }
      case StepResult::reduced_residual:
        break;
      case StepResult::cancelled:
        stopped_ = true;
        return {};
      case StepResult::linear_solver_failed:
        return {.hopeless = n == 0, .why = linear_solver_failure()};
      case StepResult::indefinite_tangent:
        return no_stiffness(u, n == 0, "it has no stiffness against a motion",
                            gradients_.direction());
      case StepResult::no_progress:  // x is then mostly the motion without resistance
        return no_stiffness(u, n == 0,
                            "it has next to no stiffness against a motion that the loads drive",
                            gradients_.x());
      case StepResult::not_finite:
        return {.why = "the forces are no longer finite"};
    }
    std::fill(change.begin(), change.end(), 0.0);
  }
  return careful_ ? explain_failure(displacement, u) : Outcome{};
}

/// Returns why a search with line search failed. It started at the state of rest `last` and ended
/// at u. The direction is a motion that u does not resist or, if none is found, the motion to u.
Outcome Newton::explain_failure(const Field& last, const Field& u) {
  system_.linearise(u, force_);
  system_.prepare();
  if (Field motion = softening_motion(system_, gradients_, u); !motion.empty())
    return {.why = "Newton's method comes to states whose stiffness against a motion is negative",
            .buckles = true,
            .direction = std::move(motion)};
  Field away = u;
  for (std::size_t n = 0; n < away.size(); ++n) away[n] -= last[n];
  return {.why = "Newton's method leaves the last state of rest by a motion and does not converge",
          .direction = std::move(away)};
}

/// Returns why conjugate gradients failed.
std::string Newton::linear_solver_failure() const {
  const double stiffest = system_.stiffest();
  if (!std::isfinite(stiffest))
    return "springs are stiffer than 3e38 N/m, more than the tangent's numbers hold";
  if (stiffest == 0)
    return "no spring has a stiffness of at least 1e-38 N/m, the least that the tangent's numbers "
           "hold";
  return "the linear equations of the tangent could not be solved";
}

Outcome Newton::no_stiffness(const Field& u, bool hopeless, const char* why,
                             const Field& direction) const {
  Field driving = right_;
  const double unit = power_of_two(largest(driving));
  for (double& value : driving) value /= unit;
  if (FreeMotions::Driven rigid = FreeMotions(system_, u).driven_by(driving);
      !rigid.sentence.empty())
    return {.hopeless = hopeless,
            .why = std::move(rigid.sentence) + ", which the loads drive and nothing resists",
            .rigid = true,
            .direction = std::move(rigid.motion)};
  return {.hopeless = hopeless, .why = why, .direction = direction};
}

/// Returns whether the strains of u may change the stiffness of the heights, against the undeformed
/// body, whose tangents are the present ones. The residual does not show this: smooth heights have
/// the same forces.
bool Newton::may_wrinkle(const Field& u) const {
  const StaticGrid& grid = problem_.grid;
  if (grid.components < 4) return false;
  double apart = 0;
  system_.for_springs([&](std::int64_t a, std::int64_t b) {
    for (std::int64_t c = 0; c < 3; ++c)
      apart = std::max(apart, std::abs(u[static_cast<std::size_t>(c * grid.places + b)] -
                                       u[static_cast<std::size_t>(c * grid.places + a)]));
  });
  return holds_heights_otherwise(system_.stiffest() * apart / grid.spacing,
                                 system_.softest_height());
}

/// Checks whether the state of rest u is stable, and prepares the system at u.
Outcome Newton::check_stability(const Field& u) {
  system_.linearise(u, force_);
  system_.prepare();
  Field motion = softening_motion(system_, gradients_, u);
  prepared_ = motion.empty();
  if (prepared_) return {.at_rest = true};
  return {.why = "its stiffness against a motion is negative",
          .buckles = true,
          .direction = std::move(motion)};
}

/// Evaluates the out-of-balance forces and the residual at trial_ = u + part * moved. Returns false
/// if they are not finite.
bool Newton::evaluate_residual(const Field& u, const Field& moved, double part) {
  for (std::size_t n = 0; n < u.size(); ++n) trial_[n] = u[n] + part * moved[n];
  problem_.respond(trial_.data(), rest_.data(), nullptr);
  scale_ = problem_.force_scale(rest_.data(), external_.data());
  for (std::size_t n = 0; n < rest_.size(); ++n) rest_[n] += external_[n];
  system_.mask(rest_.data());
  const double left = largest(rest_);
  report_.residual = left <= round_off_ ? 0 : left / scale_;
  return std::isfinite(left);
}

/// Moves u to the end of the step that was evaluated last. A careful search first shortens the step
/// while the work of the out-of-balance forces along the step at its end is below -1/2 of the work
/// at its start: the potential rises again there, and a shorter step ends near its minimum. Returns
/// false if forces are not finite.
bool Newton::step_along(const Field& moved, Field& u) {
  constexpr double too_far = 0.5, least = 0.1, most = 0.5;
  constexpr int tries = 8;
  const double start = product(right_.data(), moved.data(), u.size(), system_.threads());
  double part = 1;
  for (int n = 0; careful_ && n < tries; ++n) {
    const double end = std::isfinite(report_.residual)
                           ? product(rest_.data(), moved.data(), u.size(), system_.threads())
                           : -infinity;
    if (end >= -too_far * start) break;
    part *= std::clamp(start / (start - end), least, most);
    evaluate_residual(u, moved, part);
  }
  u = trial_;
  return std::isfinite(report_.residual);
}

/// Makes one step of Newton's method, in which held components change by `change`. Conjugate
/// gradients stop when the forces at the present end of the step differ from the prediction of the
/// tangent: then a new tangent is more useful.
Newton::StepResult Newton::step(const Field& change, Field& u) {
  constexpr double first_look = 1e-2, agreement = 0.5, done = 0.7;
  const bool prepared = std::exchange(prepared_, false);
  if (!prepared) system_.linearise(u, force_);
  // A body that moves far, or that has a part far stiffer than the rest, has no more digits left.
  constexpr double digits = 4 * std::numeric_limits<double>::epsilon();
  round_off_ = digits * system_.stiffest() * largest(u);
  for (std::size_t n = 0; n < u.size(); ++n) right_[n] = force_[n] + external_[n];
  const bool moves = largest(change) > 0;
  if (moves) {
    system_.multiply(change.data(), held_part_.data());
    for (std::size_t n = 0; n < u.size(); ++n) right_[n] -= held_part_[n];
  }
  system_.mask(right_.data());
  const double start = largest(right_);
  if (start == 0) {
    const bool finite = evaluate_residual(u, change);
    u = trial_;
    return finite && report_.residual <= limits_.tolerance ? StepResult::converged
                                                           : StepResult::reduced_residual;
  }
  if (!prepared) system_.prepare();
  gradients_.start(right_);
  Field moved(u.size());
  double next_look = std::max(first_look * start, done * limits_.tolerance * scale_);
  for (int n = 0; n < system_.most_iterations(); ++n) {
    if (!gradients_.advance())
      return gradients_.is_sound() ? StepResult::indefinite_tangent
                                   : StepResult::linear_solver_failed;
    ++report_.iterations;
    if (!host_.report(report_)) return StepResult::cancelled;
    const double unit = gradients_.unit(), left = unit * largest(gradients_.residual());
    if (!std::isfinite(left)) return StepResult::linear_solver_failed;
    if (left > next_look) continue;
    for (std::size_t m = 0; m < moved.size(); ++m) moved[m] = unit * gradients_.x()[m] + change[m];
    if (!evaluate_residual(u, moved))
      return !moves && step_along(moved, u) ? StepResult::reduced_residual : StepResult::not_finite;
    if (report_.residual <= limits_.tolerance) {
      u = trial_;
      Field error(u.size());
      system_.apply(rest_, error);
      const double size = largest(u);
      report_.displacement_error = size > 0 ? largest(error) / size : 0;
      return host_.report(report_) ? StepResult::converged : StepResult::cancelled;
    }
    double bent = 0;  // largest force that the tangent does not predict
    for (std::size_t m = 0; m < rest_.size(); ++m)
      bent = std::max(bent, std::abs(rest_[m] - unit * gradients_.residual()[m]));
    if (bent > agreement * left) {
      if (!moves)
        return step_along(moved, u) ? StepResult::reduced_residual : StepResult::not_finite;
      u = trial_;  // held components must reach their prescribed displacements
      return StepResult::reduced_residual;
    }
    next_look = std::max(std::min(bent, 0.5 * left), done * limits_.tolerance * scale_);
    if (next_look >= left) next_look = 0.5 * left;
  }
  return StepResult::no_progress;
}

}  // namespace hyperlattice::equilibrium
