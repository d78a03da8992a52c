// Whether steps in time of a given length are stable.
#pragma once

#include <support/scenes.hpp>

namespace hyperlattice::test {

/// Returns the growth of the largest displacement over 600 steps of this fraction of the critical
/// step, from noise so small that the springs stay linear. `damping`: of local damping.
inline double growth(const Model& model, double fraction, double damping = 0) {
  Simulation simulation(model, 1);
  simulation.set_damping(damping);
  const double size = 1e-16;
  simulation.set_displacements(
      noise(3 * model.body.particles, size, 1),
      model.degrees_of_freedom == 4 ? noise(model.body.particles, size, 2) : std::vector<double>{});
  for (int n = 0; n < 600; ++n) simulation.step(fraction * model.step_limit.time_step);
  return largest(displacements(simulation)) / size;
}

}  // namespace hyperlattice::test
