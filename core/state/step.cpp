// A time step, and changes of its length and of the mass: at a run's start, after a body was
// brought to rest, and where a stage's steps differ from those before.
//
// The kick from v(n-1/2) to v(n+1/2) lasts half a step of the old length and half a step of the new
// one, so that v(n) belongs to the time of the displacements for any lengths. The energy of the
// scheme with steps of 2 h is less than 1/2 v(n).M.v(n) by 1/2 h^2 a.M.a. A new length changes this
// difference; the energy at the start takes up the change.
#include <state/state.hpp>

#include <cmath>

namespace hyperlattice {

void Simulation::State::step(double length) {
  if (length != clock.last_step()) change_step(length);
  const std::int64_t elsewhere = sweeps.step({clock.last_step() / 2, length / 2, length, 0});
  failures.collect(length, elsewhere > 0);
  clock.advance(length);
}

/// Prepares a step of this length, s, after a step of another length.
void Simulation::State::change_step(double length) {
  constexpr double round_off = 1e-9;
  const double last = clock.last_step();
  if (last > 0 && std::abs(length - last) <= round_off * last) return;
  if (last == 0 && loads.start_motion(length)) energy.forget_start();
  energy.find_start();
  const double back = last / 2, forward = length / 2, ratio = back / forward;
  const RowSums sums = sweeps.measure({back, forward, length, forward});
  energy.shift_start((ratio * ratio - 1) * (sums.kinetic_mean - sums.kinetic));
}

/// Velocities are those half a step before. They change so that the next step is that of the new
/// mass from v(n) on. The error of the balance stays: the energy at the start takes up the change.
void Simulation::State::set_added_mass(double time_step) {
  if (time_step == added.time_step()) return;
  if (clock.steps() == 0) return added.start(time_step);
  const double back = clock.last_step() / 2, error = energy.balance().error;
  added.kick(back, -1, sweeps.damping());
  added.start(time_step);
  sweeps.measure(Sweep::present(clock.last_step()));
  added.kick(back, 1, sweeps.damping());
  blocks.exchange_ranks();  // each rank knows the impulses of its own blocks
  energy.shift_start(energy.balance().error - error);
}

}  // namespace hyperlattice
