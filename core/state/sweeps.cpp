#include <host/plugin_call.hpp>
#include <model/arithmetic.hpp>
#include <model/law.hpp>
#include <state/load_work.hpp>
#include <state/sweeps.hpp>

namespace hyperlattice {

Sweeps::Sweeps(BlockSet& blocks, ActingLoads& loads, ArrayCriteria& arrays,
               const SpringReview& review, NodalPressures& pressures, DamageField& damage,
               LocalForces& local, AddedMass& added, const OtherRows& other_rows)
    : blocks_(blocks),
      model_(blocks.model()),
      loads_(loads),
      arrays_(arrays),
      review_(review),
      pressures_(pressures),
      damage_(damage),
      local_(local),
      added_(added),
      other_rows_(other_rows),
      exact_(asked_for_exact_springs()) {}

void Sweeps::set_damping(double alpha, double rate) {
  damping_ = alpha;
  damping_rate_ = rate;
}

std::int64_t Sweeps::step(const Sweep& sweep) {
  blocks_.prepare();
  loads_.prepare(sweep);
  loads_.check_factors();
  if (!damage_.empty()) damage_.update(2 * sweep.after);
  read_motion();
  if (!arrays_.empty()) arrays_.ask();
  if (!pressures_.empty()) pressures_.update();
  const LocalForces::Taken taken = local_steps(sweep, true);
  blocks_.for_mine([&](Block& block) {
    if (local_.empty()) loads_.set_supports(block, sweep);
    if (!damage_.empty()) damage_.watch_shortening(block);
    run_kernel(model_.springs.kernels().step, block, sweep.before, sweep.after, false);
    if (!added_.empty()) added_.after_step(block, sweep.before, sweep.after, damping_);
    count_work(block, sweep.before + sweep.after);
  });
  loads_.check_answers();
  const std::int64_t broken = blocks_.exchange_ranks();
  loads_.update_memory();
  if (!damage_.empty()) damage_.finish();
  return broken;
}

RowSums Sweeps::measure(const Sweep& sweep) {
  blocks_.prepare();
  loads_.prepare(sweep);
  if (!damage_.empty()) damage_.evaluate();
  read_motion();
  if (!pressures_.empty()) pressures_.update();
  const LocalForces::Taken taken = local_steps(sweep, false);
  blocks_.for_mine([&](Block& block) {
    if (local_.empty()) loads_.set_supports(block, sweep);
    run_kernel(model_.springs.kernels().measure, block, sweep.measured, 0, true);
    if (!added_.empty()) added_.after_measurement(block, 2 * sweep.measured, damping_);
  });
  blocks_.gather_results();
  RowSums total;
  for (const Block& block : blocks_)
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
  return total;
}

/// Computes the forces of local steps, if there are any. These need the external forces of all
/// blocks.
LocalForces::Taken Sweeps::local_steps(const Sweep& sweep, bool breaks) {
  if (local_.empty()) return LocalForces::Taken(nullptr);
  blocks_.team().for_each(blocks_.size(),
                          [&](std::size_t b) { loads_.set_supports(blocks_[b], sweep); });
  return local_.compute(sweep.step > 0 ? sweep.step : 2 * sweep.before, breaks);
}

void Sweeps::set_loads(const Sweep& sweep) {
  loads_.prepare(sweep);
  read_motion();
  blocks_.team().for_each(blocks_.size(),
                          [&](std::size_t b) { loads_.set_supports(blocks_[b], sweep); });
}

void Sweeps::check_loads() const {
  loads_.check_factors();
  loads_.check_answers();
}

/// Copies ghost planes, and lets loads see the motion of the particles that they watch.
void Sweeps::read_motion() {
  blocks_.team().for_each(blocks_.size(), [&](std::size_t b) {
    if (!blocks_.is_mine(blocks_[b]) && !blocks_.is_whole()) return;
    blocks_.exchange(blocks_[b]);
    loads_.watch(blocks_[b]);
  });
  loads_.share_watched();
  loads_.prepare_answers();
}

inline void Sweeps::run_kernel(Kernel kernel, Block& block, double back, double forward,
                               bool measures) const {
  struct Host {
    const Sweeps* sweeps;
    Block* block;
    KernelRequest request;
    bool measures;
  } host{this, &block, request_for(block, back, forward), measures};
  host.request.self = &host;
  if (model_.springs.breakable)
    host.request.review = [](void* self, const AlarmRow& alarm) noexcept {
      return PluginCall::answer(static_cast<const std::uint8_t*>(nullptr), [&] {
        const auto* asked = static_cast<const Host*>(self);
        return asked->sweeps->review_.review(*asked->block, alarm);
      });
    };
  host.request.receive_gone = [](void* self, const AlarmRow& springs) noexcept {
    PluginCall::answer([&] {
      const auto* asked = static_cast<const Host*>(self);
      asked->sweeps->blocks_.note_gone(*asked->block, springs);
    });
  };
  host.request.other_row = [](void* self, const RowPlace& row) noexcept {
    PluginCall::answer([&] {
      const auto* asked = static_cast<const Host*>(self);
      asked->sweeps->other_rows_.compute(*asked->block, asked->request, row, asked->measures);
    });
  };
  call_kernel(model_.springs.laws.front(), kernel, host.request);
}

KernelRequest Sweeps::request_for(Block& block, double back, double forward) const {
  KernelRequest request;
  blocks_.layout().describe(block, request);
  request.rows = block.rows.data();
  for (int c = 0; c < model_.degrees_of_freedom; ++c) {
    request.displacement[c] = block.displacement[c].get();
    request.velocity[c] = block.velocity[c].get();
  }
  request.alive = block.alive.get();
  request.material = block.material.get();
  request.neighbours = model_.springs.neighbours;
  request.springs = model_.springs.constants.data();
  request.mass = model_.kinds.masses.data();
  request.alpha = model_.kinds.alphas.data();
  request.materials = static_cast<std::uint32_t>(model_.materials.size());
  request.spring_classes = model_.body.grid.spring_classes;
  request.membrane_distance = model_.body.grid.membrane_distance;
  request.exact = exact_;
  request.back = back;
  request.forward = forward;
  request.damping = damping_;
  request.damping_rate = damping_rate_;
  request.acceleration = model_.loads.acceleration;
  request.boundary_particles =
      added_.empty() ? block.boundary_particles.data() : added_.before_kernel(block);
  request.scratch = block.scratch.get();
  request.damped_work = block.damped_work.data();
  request.fracture_work = block.fracture_work.empty() ? nullptr : block.fracture_work.data();
  request.sums = block.sums.data();
  return request;
}

void Sweeps::archive(Archive& archive) {
  archive(damping_);
  archive(damping_rate_);
}

}  // namespace hyperlattice
