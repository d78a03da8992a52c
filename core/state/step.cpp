// One step: ghost planes, loads, the kernel on every block, then the energy of broken springs.
#include <host/plugin_call.hpp>
#include <model/law.hpp>
#include <state/parts.hpp>

namespace hyperlattice {

void Simulation::Parts::step(double dt) {
  if (dt != last_step) change_step(dt);
  const Sweep sweep{last_step / 2, dt / 2, dt, 0};
  prepare_loads(sweep);
  check_factors();
  const auto kernel =
      damping != 0 || damping_rate != 0 ? model.kernels().step_damped : model.kernels().step;
  team.for_each(blocks.size(), [&](std::size_t b) {
    layout->exchange(blocks, blocks[b]);
    watch(blocks[b]);
  });
  if (prepares) prepare_answers();
  team.for_each(blocks.size(), [&](std::size_t b) {
    Block& block = blocks[b];
    prepare_supports(block, sweep);
    run_kernel(kernel, block, sweep.before, sweep.after, false);
    for (Contribution& part : block.contributions) {
      const BoundaryParticle& support = block.boundary_particles[part.support];
      part.work += part.factor * dot(part.force, support.path);
      if (support.axes != 0)
        part.held_work += part.factor * dot(part.force, along(support.axes, support.path));
    }
  });
  check_answers();
  collect_breakages(dt);
  if (!time_held) {
    const double added = dt - time_rest, sum = time + added;
    time_rest = (sum - time) - added;
    time = sum;
  }
  advanced = time_held ? 0 : dt;
  last_step = dt;
  ++steps;
}

void Simulation::Parts::run_kernel(decltype(KernelSet::step) kernel, Block& block, double back,
                             double forward, bool measuring) {
  struct Host {
    const Parts* parts;
    Block* block;
    KernelRequest request;
    bool measuring;
  } host{this, &block, request_for(block, back, forward), measuring};
  host.request.self = &host;
  host.request.review = [](void* self, const AlarmRow& alarm) noexcept {
    return PluginCall::answer(static_cast<const std::uint8_t*>(nullptr), [&] {
      const auto* asked = static_cast<const Host*>(self);
      return asked->parts->review(*asked->block, alarm);
    });
  };
  host.request.receive_gone = [](void* self, const AlarmRow& springs) noexcept {
    PluginCall::answer([&] {
      const auto* asked = static_cast<const Host*>(self);
      asked->parts->receive_gone(*asked->block, springs);
    });
  };
  host.request.other_row = [](void* self, const RowPlace& row) noexcept {
    PluginCall::answer([&] {
      const auto* asked = static_cast<const Host*>(self);
      asked->parts->compute_other_row(*asked->block, asked->request, row, asked->measuring);
    });
  };
  call_kernel(model.laws.front(), kernel, host.request);
}

KernelRequest Simulation::Parts::request_for(Block& block, double back, double forward) const {
  KernelRequest request;
  layout->describe(block, request);
  request.rows = block.rows.data();
  for (int c = 0; c < model.degrees_of_freedom; ++c) {
    request.displacement[c] = block.displacement[c].get();
    request.velocity[c] = block.velocity[c].get();
  }
  request.alive = block.alive.get();
  request.material = block.material.get();
  request.neighbours = model.neighbours;
  request.springs = model.springs.data();
  request.mass = model.masses.data();
  request.alpha = model.alphas.data();
  request.materials = static_cast<std::uint32_t>(model.materials.size());
  request.spring_classes = model.body.grid.spring_classes;
  request.membrane_distance = model.body.grid.membrane_distance;
  request.exact = exact;
  request.back = back;
  request.forward = forward;
  request.damping = damping;
  request.damping_rate = damping_rate;
  request.acceleration = model.acceleration;
  request.boundary_particles = block.boundary_particles.data();
  request.scratch = block.scratch.get();
  request.damped_work = block.damped_work.data();
  request.fracture_work = block.fracture_work.empty() ? nullptr : block.fracture_work.data();
  request.sums = block.sums.data();
  return request;
}

}  // namespace hyperlattice
