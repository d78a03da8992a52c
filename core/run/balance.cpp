// The energy books. The scheme's own energy, 1/2 v(n-1/2).M.v(n+1/2) plus what the springs store at n, is constant up to what loads put in
// and what damping and failure take; each of those is counted over the same half steps, so that the balance closes to round-off for small
// strains and to the square of the step otherwise.
#include <run/parts.hpp>

#include <algorithm>
#include <cmath>

namespace hyperlattice {

/// Sums of the present state, in the rows' order whatever the blocks are; `back`: half of the step before. Changes nothing but the results in
/// rows and supports.
RowSums Simulation::Parts::measure(double back) {
  prepare_loads(2 * back);
#pragma omp parallel num_threads(threads)
  {
#pragma omp for schedule(static, 1)
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      layout->exchange(blocks, blocks[b]);
      watch(blocks[b]);
    }
    if (prepares) {
#pragma omp single
      prepare_answers();
    }
#pragma omp for schedule(static, 1)
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      prepare_supports(blocks[b], 2 * back);
      model.kernels.measure(request_for(blocks[b], back, 0));
    }
  }
  RowSums total;
  for (const Block& block : blocks)
    for (std::size_t r = block.layout->first_own; r < block.layout->last_own; ++r) {
      if (block.rows[r].begin == block.rows[r].end) continue;
      const RowSums& row = block.sums[r];
      total.stored += row.stored;
      total.kinetic += row.kinetic;
      total.kinetic_mean += row.kinetic_mean;
      total.momentum = total.momentum + row.momentum;
      total.potential += row.potential;
      total.damped += row.damped + block.damped_work[r];
    }
  total.damped += halted_energy;
  total.potential -= gravity_unused;
  return total;
}

/// What the state at the start of the books held already.
void Simulation::Parts::find_start() {
  if (start_known) return;
  start_known = true;
  const RowSums sums = measure(last_step / 2);
  start_potential = sums.potential;
  start_energy = sums.kinetic + sums.stored + sums.damped + failure_energy;
  for (const double work : work_by_load(0)) start_energy -= work;
}

/// J that each load put in, up to the state that was measured last. What holds a particle counts for the load that holds it.
std::vector<double> Simulation::Parts::work_by_load(double potential) const {
  std::vector<double> work(model.loads.size(), 0);
  for (const Block& block : blocks) {
    std::uint32_t counted = ~0u;
    for (const Contribution& part : block.contributions) {
      const Support& support = block.supports[part.support];
      work[part.load] += part.work + part.factor * dot(part.force, support.path);
      if ((part.displaced | part.driven) == 0 || part.support == counted) continue;
      counted = part.support;
      work[part.load] += support.reaction_work + support.reaction_now;
    }
  }
  const double acceleration = norm(model.acceleration);
  if (acceleration > 0)  // body accelerations share the potential's work by their part of the whole
    for (std::size_t l = 0; l < model.loads.size(); ++l)
      work[l] += potential * dot(model.loads[l].acceleration, model.acceleration) / (acceleration * acceleration);
  return work;
}

Balance Simulation::Parts::balance() {
  find_start();
  const RowSums sums = measure(last_step / 2);
  Balance balance;
  balance.kinetic = sums.kinetic;
  balance.kinetic_mean = sums.kinetic_mean;
  balance.stored = sums.stored;
  balance.momentum = sums.momentum;
  balance.dissipated_damping = sums.damped;
  balance.dissipated_failure = failure_energy;
  for (const double work : work_by_load(sums.potential - start_potential)) balance.injected += work;
  balance.error = balance.kinetic + balance.stored + balance.dissipated() - balance.injected - start_energy;
  largest_energy =
      std::max({largest_energy, std::abs(balance.kinetic) + std::abs(balance.stored), std::abs(balance.injected), std::abs(start_energy)});
  balance.scale = largest_energy;
  return balance;
}

}  // namespace hyperlattice
