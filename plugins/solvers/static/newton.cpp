#include "newton.hpp"

#include <hyperlattice/files.hpp>

namespace hyperlattice::statics {

Newton::Newton(const StaticProblem& problem, const SolverHost& host, const Limits& limits)
    : problem_(problem), host_(host), limits_(limits), matrix_(problem), multigrid_(matrix_), gradients_(matrix_, multigrid_) {
  for (Field* field : {&external_, &force_, &trial_, &rest_, &right_, &held_part_}) field->assign(problem.grid.numbers(), 0);
}

Found Newton::find(double share, Field& displacement) {
  Field u = displacement;
  problem_.load(share, external_.data());
  Field change = u;  // of what the loads move
  problem_.prescribe(share, change.data());
  for (std::size_t n = 0; n < change.size(); ++n) change[n] -= u[n];

  for (int n = 0; n < limits_.newton; ++n) {
    switch (step(change, u)) {
      case Step::at_rest:
        displacement = u;
        return {true, false, {}, {}};
      case Step::better:
        break;
      case Step::stopped:
        stopped_ = true;
        return {};
      case Step::lost:
        return {false, n == 0, "it has no stiffness against a motion", gradients_.direction()};
      case Step::useless:  // what they found by then is for the most part the motion that they cannot resist
        return {false, n == 0, "it has next to no stiffness against a motion that the loads drive", gradients_.x()};
      case Step::wild:
        return {false, false, "the forces are no longer finite", {}};
    }
    std::fill(change.begin(), change.end(), 0.0);
  }
  return {false, false, "Newton's method does not converge", {}};
}

/// The out-of-balance forces at u + moved, and what they are compared with. False: they are not finite.
bool Newton::look(const Field& u, const Field& moved) {
  for (std::size_t n = 0; n < u.size(); ++n) trial_[n] = u[n] + moved[n];
  problem_.respond(trial_.data(), rest_.data(), nullptr);
  scale_ = problem_.force_scale(rest_.data(), external_.data());
  for (std::size_t n = 0; n < rest_.size(); ++n) rest_[n] += external_[n];
  matrix_.mask(rest_.data());
  const double left = largest(rest_);
  report_.residual = left == 0 ? 0 : left / scale_;
  return std::isfinite(left);
}

/// One step of Newton's method, in which held components change by `change`. Conjugate gradients go on while the forces at the present end of the
/// step agree with what the tangent says of them; from there on a new tangent serves better.
Newton::Step Newton::step(const Field& change, Field& u) {
  constexpr double first_look = 1e-2, agreement = 0.5, done = 0.7;
  matrix_.linearise(u, force_);
  for (std::size_t n = 0; n < u.size(); ++n) right_[n] = force_[n] + external_[n];
  const bool moves = largest(change) > 0;
  if (moves) {
    matrix_.multiply(change.data(), held_part_.data());
    for (std::size_t n = 0; n < u.size(); ++n) right_[n] -= held_part_[n];
  }
  matrix_.mask(right_.data());
  const double start = largest(right_);
  if (start == 0) {
    const bool finite = look(u, change);
    u = trial_;
    return finite && report_.residual <= limits_.tolerance ? Step::at_rest : Step::better;
  }
  multigrid_.build();
  gradients_.start(right_);
  Field moved(u.size());
  double next_look = first_look * start;
  for (int n = 0; n < limits_.iterations; ++n) {
    if (!gradients_.advance()) return Step::lost;
    ++report_.iterations;
    if (!host_.report(report_)) return Step::stopped;
    const double left = largest(gradients_.residual());
    if (!std::isfinite(left)) return Step::lost;
    if (left > next_look) continue;
    for (std::size_t m = 0; m < moved.size(); ++m) moved[m] = gradients_.x()[m] + change[m];
    if (!look(u, moved)) return Step::wild;
    if (report_.residual <= limits_.tolerance) {
      u = trial_;
      Field error(u.size());
      multigrid_.apply(rest_, error);
      const double size = largest(u);
      report_.displacement_error = size > 0 ? largest(error) / size : 0;
      return host_.report(report_) ? Step::at_rest : Step::stopped;
    }
    double bent = 0;  // what the tangent does not know
    for (std::size_t m = 0; m < rest_.size(); ++m) bent = std::max(bent, std::abs(rest_[m] - gradients_.residual()[m]));
    if (bent > agreement * left) {
      u = trial_;
      return Step::better;
    }
    next_look = std::max(std::min(bent, 0.5 * left), done * limits_.tolerance * scale_);
    if (next_look >= left) next_look = 0.5 * left;
  }
  return Step::useless;
}

}  // namespace hyperlattice::statics
