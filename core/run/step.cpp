// One step: ghost planes, loads, the kernel on every block, then the books of what broke.
#include <run/parts.hpp>

#include <algorithm>

namespace hyperlattice {
namespace {

void set_component(Vec3& v, int c, double value) { (c == 0 ? v.x : c == 1 ? v.y : v.z) = value; }

}  // namespace

void Simulation::Parts::step(double dt) {
  if (steps == 0) start(dt);
  const double back = last_step / 2, forward = dt / 2;
  prepare_loads(dt);
  const auto kernel = damping != 0 || damping_rate != 0 ? model.kernels.step_damped : model.kernels.step;
  struct Reviewer {
    const Parts* parts;
    Block* block;
  };
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
      Block& block = blocks[b];
      prepare_supports(block, dt);
      Reviewer reviewer{this, &block};
      KernelRequest request = request_for(block, back, forward);
      request.self = &reviewer;
      request.review = [](void* self, const AlarmRow& alarm) noexcept {
        const auto* asked = static_cast<const Reviewer*>(self);
        return asked->parts->review(*asked->block, alarm);
      };
      kernel(request);
      for (Contribution& part : block.contributions) part.work += part.factor * dot(part.force, block.supports[part.support].path);
    }
  }
  collect_breakages(dt);
  if (!time_held) {
    const double added = dt - time_rest, sum = time + added;
    time_rest = (sum - time) - added;
    time = sum;
  }
  last_step = dt;
  ++steps;
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
  request.back = back;
  request.forward = forward;
  request.damping = damping;
  request.damping_rate = damping_rate;
  request.acceleration = model.acceleration;
  request.supports = block.supports.data();
  request.scratch = block.scratch.get();
  request.damped_work = block.damped_work.data();
  request.sums = block.sums.data();
  return request;
}

/// What the loads are at the present time and a step later. What they watch is filled in by watch().
void Simulation::Parts::prepare_loads(double step) {
  for (std::size_t l = 0; l < acting.size(); ++l) {
    Acting& load = acting[l];
    load.now = model.loads[l].factor(time);
    load.next = step > 0 && !time_held ? model.loads[l].factor(time + step) : load.now;
    load.motion = {time, load.now, load.displacement, load.velocity};
  }
}

/// Shows the loads what the block's particles do.
void Simulation::Parts::watch(const Block& block) {
  for (const Block::Watched& seen : block.watched) {
    const auto of = [&](const Numbers* field) { return Vec3{field[0][seen.index], field[1][seen.index], field[2][seen.index]}; };
    acting[seen.load].displacement[seen.number] = of(block.displacement);
    acting[seen.load].velocity[seen.number] = of(block.velocity);
  }
}

/// Once all that loads watch has been shown to them.
void Simulation::Parts::prepare_answers() {
  for (std::size_t l = 0; l < acting.size(); ++l)
    if (model.loads[l].prepares()) model.loads[l].prepare(acting[l].motion);
}

/// External forces at the present time, and the velocities that prescribed particles have during a step of that length.
void Simulation::Parts::prepare_supports(Block& block, double step) const {
  for (Support& support : block.supports) support.force = support.velocity = {};
  for (Contribution& part : block.contributions) {
    const Acting& load = acting[part.load];
    Support& support = block.supports[part.support];
    part.factor = load.now;
    if (part.watched != not_watched) {
      part.factor = 1;
      part.force = model.loads[part.load].answer(load.motion, part.watched);
    }
    support.force = support.force + part.factor * part.force;
    if ((part.displaced | part.driven) == 0 || step <= 0) continue;
    for (int c = 0; c < 3; ++c) {
      const double here = block.displacement[c][support.index];
      if ((part.displaced >> c & 1u) != 0) set_component(support.velocity, c, (load.next * component(part.displacement, c) - here) / step);
      if ((part.driven >> c & 1u) != 0) set_component(support.velocity, c, 0.5 * (load.now + load.next) * component(part.velocity, c));
    }
  }
}

/// Particles that a load drives already move with it when the run begins. The books begin with the scheme's own energy, in which the velocity
/// half a step before the start is what the forces of the start make it.
void Simulation::Parts::start(double step) {
  bool driven = false;
  prepare_loads(step);
  for (const Block& block : blocks) watch(block);
  prepare_answers();
  for (Block& block : blocks) {
    prepare_supports(block, step);
    for (const Support& support : block.supports)
      for (int c = 0; c < 3; ++c)
        if ((support.axes >> c & 1u) != 0) {
          block.velocity[c].set(support.index, component(support.velocity, c));
          driven = true;
        }
  }
  if (driven) start_known = false;
  find_start();
  const RowSums sums = measure(step / 2);
  start_energy -= sums.kinetic_mean - sums.kinetic;
}

}  // namespace hyperlattice
