// Estimates how near to rest the present state is, from its out-of-balance forces and the error of
// the displacements that they imply.
//
// The error e of the displacements and the out-of-balance forces r satisfy K e = r. The slowest
// motion of the body, of frequency w, has by far the largest error; for it e = M^-1 r / w^2. A
// motion d between two states changes the forces by -K d. Its Rayleigh quotient d.K d / d.M d is
// never below w^2 of the slowest motion and approaches it while all faster motions die away, so the
// least quotient so far is used. Other motions make the estimate larger than the error.
#include <statics/statics.hpp>

#include <algorithm>
#include <cmath>

namespace hyperlattice {

RestReport Statics::rest() {
  const StaticGrid& grid = problem_.grid;
  const Values before = state_, force_before = force_;
  if (simulation_.broken() != broken_ || problem_.damages) read_springs();
  read_state(state_.data());
  respond(state_.data(), force_.data(), nullptr);
  Values external(force_.size());
  add_loads(1, external.data());

  double largest = 0, stiffness = 0, inertia = 0, left = 0, moved = 0;
  for_runs([&](std::int64_t first, Particle particle, std::uint64_t count) {
    for (std::uint64_t n = 0; n < count; ++n) {
      const std::size_t place = static_cast<std::size_t>(first) + n;
      const double mass = model_.mass(particle + n);
      for (std::size_t c = 0; c < static_cast<std::size_t>(grid.components); ++c) {
        if ((free_[place] >> c & 1u) == 0) continue;
        const std::size_t at = c * free_.size() + place;
        const double rest = force_[at] + external[at];
        // Also takes a force that is not a number.
        if (!(std::abs(rest) <= largest)) largest = std::abs(rest);
        if (c == 3) continue;  // waves of the membranes are short
        const double d = state_[at] - before[at];
        stiffness -= d * (force_[at] - force_before[at]);
        inertia += mass * d * d;
        left += rest * rest / mass;
        moved += mass * state_[at] * state_[at];
      }
    }
  });
  // The first motion has the change of loads and constraints since the stage began.
  const bool first = !std::exchange(compared_, true);
  if (!first && stiffness > 0 && inertia > 0) slowest_ = std::min(slowest_, stiffness / inertia);
  // Needed for a body that moves while no load acts.
  if (std::isfinite(largest)) largest_scale_ = std::max(largest_scale_, largest);
  RestReport report;
  report.residual = largest == 0 ? 0 : largest / force_scale(force_.data(), external.data());
  if (moved > 0 && (left == 0 || std::isfinite(slowest_)))
    report.displacement_error = left == 0 ? 0 : std::sqrt(left / moved) / slowest_;
  return report;
}

}  // namespace hyperlattice
