// Changes of the step's length: at a run's start, after a body was brought to rest, and where a
// stage's steps differ from those before.
//
// The kick from v(n-1/2) to v(n+1/2) lasts half a step of the old length and half a step of the new
// one, so that v(n) belongs to the time of the displacements for any lengths. The energy of the
// scheme with steps of 2 h is less than 1/2 v(n).M.v(n) by 1/2 h^2 a.M.a. A new length changes this
// difference; the energy at the start takes up the change.
#include <state/parts.hpp>

#include <cmath>

namespace hyperlattice {

/// Gives the particles that a load moves the load's velocity. At the start of a run this is part of
/// the initial state, later it is the work of an impulse.
void Simulation::Parts::start_prescribed(double dt) {
  const Sweep at_once{0, 0, 0, 0};
  prepare_loads({0, dt / 2, dt, 0});  // takes limits from after the present time
  check_factors();
  for (Block& block : blocks)
    for (const Contribution& part : block.contributions) {
      if ((part.displaced | part.driven) == 0) continue;
      BoundaryParticle& support = block.boundary_particles[part.support];
      for (int c = 0; c < 3; ++c) {
        if (((part.displaced | part.driven) >> c & 1u) == 0) continue;
        const double before = block.velocity[c][support.index],
                     now = prescribed_velocity(block, part, c, at_once);
        if (now == before) continue;
        block.velocity[c].set(support.index, now);
        if (steps == 0)
          start_known = false;
        else
          support.reaction_work += 0.5 * support.mass * (now * now - before * before);
      }
    }
}

/// Prepares a step of length `dt` after a step of another length.
void Simulation::Parts::change_step(double dt) {
  constexpr double round_off = 1e-9;
  if (last_step > 0 && std::abs(dt - last_step) <= round_off * last_step) return;
  if (last_step == 0) start_prescribed(dt);
  find_start();
  const double back = last_step / 2, forward = dt / 2, ratio = back / forward;
  const RowSums sums = measure({back, forward, dt, forward});
  start_energy += (ratio * ratio - 1) * (sums.kinetic_mean - sums.kinetic);
}

}  // namespace hyperlattice
