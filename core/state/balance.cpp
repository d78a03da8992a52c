// The energy balance. The energy of the scheme, 1/2 v(n-1/2).M.v(n+1/2) plus the stored energy at
// n, changes only by the work of loads and by dissipation in damping and failure. All of these are
// counted over the same half steps, so that the balance closes to round-off for small strains and
// to the square of the step otherwise.
//
// A measurement at n ends the step's kick half-way, with the mean of the loads over the half step
// before n. Velocity and momentum are then those at n, with the exact impulse of the loads up to n,
// and no load is asked for a time after n. The error does not depend on this choice: another force
// would add to the kinetic energy its work over the same half step.
#include <model/law.hpp>
#include <state/parts.hpp>

#include <algorithm>
#include <cmath>

namespace hyperlattice {

/// Returns the sums of the present state, in the order of the rows for any number of blocks.
/// Changes nothing but the results in rows and boundary particles.
RowSums Simulation::Parts::measure(const Sweep& sweep) {
  prepare_loads(sweep);
  team.for_each(blocks.size(), [&](std::size_t b) {
    layout->exchange(blocks, blocks[b]);
    watch(blocks[b]);
  });
  if (prepares) prepare_answers();
  team.for_each(blocks.size(), [&](std::size_t b) {
    prepare_supports(blocks[b], sweep);
    run_kernel(model.kernels().measure, blocks[b], sweep.measured, 0, true);
  });
  RowSums total;
  for (const Block& block : blocks)
    for (std::size_t r = block.layout->first_own; r < block.layout->last_own; ++r) {
      if (block.rows[r].begin == block.rows[r].end) continue;
      RowSums row = block.sums[r];
      if (block.rows[r].law != 0) {
        row.stored += block.other_sums[r].stored;
        row.damped += block.other_sums[r].dissipated;
        row.fractured += block.other_sums[r].fractured;
      }
      total.stored += row.stored;
      total.kinetic += row.kinetic;
      total.kinetic_mean += row.kinetic_mean;
      total.momentum = total.momentum + row.momentum;
      total.potential += row.potential;
      total.damped += row.damped + block.damped_work[r];
      if (!block.fracture_work.empty()) total.fractured += row.fractured + block.fracture_work[r];
    }
  total.damped += halted_energy;
  total.fractured += softened_energy;
  total.potential -= gravity_unused;
  return total;
}

/// Finds the energy and the potential of the state at the start of the balance.
void Simulation::Parts::find_start() {
  if (start_known) return;
  start_known = true;
  const RowSums sums = measure_now();
  start_potential = sums.potential;
  start_energy = sums.kinetic + sums.stored + sums.damped + sums.fractured + failure_energy;
  for (const double work : work_by_load(0)) start_energy -= work;
}

/// Returns the work of each load, J, up to the state that was measured last. The reaction of a
/// constraint counts for its load, and takes back the work of other loads along the same axes.
std::vector<double> Simulation::Parts::work_by_load(double potential) const {
  std::vector<double> work(model.loads.size(), 0);
  for (const Block& block : blocks) {
    std::vector<double> held(block.boundary_particles.size(), 0);
    for (const Contribution& part : block.contributions) {
      const BoundaryParticle& support = block.boundary_particles[part.support];
      work[part.load] += part.work + part.factor * dot(part.force, support.path);
      if (support.axes != 0)
        held[part.support] +=
            part.held_work + part.factor * dot(part.force, along(support.axes, support.path));
    }
    std::uint32_t counted = ~0u;
    for (const Contribution& part : block.contributions) {
      if ((part.displaced | part.driven) == 0 || part.support == counted) continue;
      counted = part.support;
      const BoundaryParticle& support = block.boundary_particles[part.support];
      work[part.load] += support.reaction_work + support.reaction_now - held[part.support];
    }
  }
  const double acceleration = norm(model.acceleration);
  // Body accelerations share the work of the potential in proportion to their part of the whole.
  if (acceleration > 0)
    for (std::size_t l = 0; l < model.loads.size(); ++l)
      work[l] += potential * dot(model.loads[l].acceleration, model.acceleration) /
                 (acceleration * acceleration);
  return work;
}

/// Returns the sum of the absolute works, J, of each load on each particle, because works may
/// cancel. A body acceleration on a held particle and the reaction also cancel in each step.
double Simulation::Parts::gross_work(double potential) const {
  double sum = std::abs(potential);
  const Vec3 gained = last_step * model.acceleration;
  for (const Block& block : blocks) {
    for (const Contribution& part : block.contributions)
      sum += std::abs(part.work +
                      part.factor * dot(part.force, block.boundary_particles[part.support].path));
    for (const BoundaryParticle& support : block.boundary_particles)
      sum += std::abs(support.reaction_work + support.reaction_now) +
             (support.axes != 0 ? 0.5 * support.mass * dot(gained, gained) : 0);
  }
  return sum;
}

EnergyBalance Simulation::Parts::balance() {
  find_start();
  const RowSums sums = measure_now();
  check_factors();
  check_answers();
  EnergyBalance balance;
  balance.kinetic = sums.kinetic;
  balance.kinetic_mean = sums.kinetic_mean;
  balance.stored = sums.stored;
  balance.momentum = sums.momentum;
  balance.dissipated_damping = sums.damped;
  balance.dissipated_failure = failure_energy + sums.fractured;
  const double potential = sums.potential - start_potential;
  for (const double work : work_by_load(potential)) balance.injected += work;
  balance.error =
      balance.kinetic + balance.stored + balance.dissipated() - balance.injected - start_energy;
  largest_energy =
      std::max({largest_energy, std::abs(balance.kinetic) + std::abs(balance.stored),
                std::abs(balance.dissipated_failure), std::abs(balance.dissipated_damping),
                std::abs(balance.injected), gross_work(potential), std::abs(start_energy)});
  balance.scale = largest_energy;
  return balance;
}

}  // namespace hyperlattice
