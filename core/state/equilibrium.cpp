// From one state of rest to the next, and implicit steps in time: holds the time, stops the motion,
// takes over the result of a solver and continues the energy balance of the explicit steps.
#include <state/load_work.hpp>
#include <state/state.hpp>

namespace hyperlattice {

/// Gives the body another motion, for its lifetime.
class Simulation::OtherMotion {
 public:
  OtherMotion(Simulation& simulation, const EquilibriumUpdate& other) : simulation_(simulation) {
    simulation.displacements(own_.xyz);
    simulation.heights(own_.heights);
    if (!other.velocity.empty()) {
      simulation.velocities(own_.velocity);
      simulation.height_rates(own_.height_rate);
    }
    simulation.set_motion(other);
  }
  ~OtherMotion() { simulation_.set_motion(own_); }
  OtherMotion(const OtherMotion&) = delete;
  OtherMotion& operator=(const OtherMotion&) = delete;

 private:
  Simulation& simulation_;
  EquilibriumUpdate own_;
};

/// Sets displacements and heights, and velocities if the update has them.
void Simulation::set_motion(const EquilibriumUpdate& to) {
  set({false, 0, 3}, to.xyz);
  if (!to.heights.empty()) set({false, 3, 1}, to.heights);
  if (!to.velocity.empty()) set({true, 0, 3}, to.velocity);
  if (!to.height_rate.empty()) set({true, 3, 1}, to.height_rate);
}

void Simulation::hold_time(double time) {
  if (state_->clock.is_held()) return;
  whole().loads.leave_rest();
  state_->loads.set_goals(time);
  state_->clock.hold(time);
}
void Simulation::release_time() { state_->clock.release(); }

void Simulation::halt() {
  EnergyAccount& energy = state_->energy;
  const double error = energy.balance().error;
  gather();
  for (const Block& block : state_->blocks)
    for (int c = 0; c < state_->blocks.model().degrees_of_freedom; ++c) block.velocity[c].clear();
  state_->clock.rest();
  energy.count_intervention();
  energy.count_halted(error - energy.balance().error);
}

double Simulation::apply_equilibrium(const EquilibriumUpdate& to) {
  state_->blocks.ranks().meet(Ranks::Meeting::state);
  gather();
  const double error = to.settles ? state_->energy.balance().error : 0;
  if (to.time_step == 0)
    halt();  // finds the start of the balance; the work on the way from there is counted here
  count_work(state_->blocks, to);
  const Model& model = state_->blocks.model();
  if (!(model.loads.acceleration == Vec3{})) {
    const double unused = 1 - 0.5 * (to.gravity_before + to.gravity);
    std::vector<double> before;
    displacements(before);
    for (Particle p = 0; p < model.body.particles; ++p) {
      const Vec3 moved{to.xyz[3 * p] - before[3 * p], to.xyz[3 * p + 1] - before[3 * p + 1],
                       to.xyz[3 * p + 2] - before[3 * p + 2]};
      state_->energy.count_unused_gravity(unused * model.mass(p) *
                                          dot(model.loads.acceleration, moved));
    }
  }
  state_->energy.count_halted(to.dissipated);
  state_->law_memory.advance(to);
  const bool damages = !state_->damage.empty();
  if (damages && to.time_step == 0) state_->damage.accept_search(to.time);
  set_motion(to);
  if (damages && to.time_step == 0) state_->damage.finish();
  if (to.time_step == 0) state_->loads.rest(to.factor, to.gravity);
  state_->clock.jump(to.time, to.time_step);
  const double growth = damages && to.time_step > 0
                            ? state_->damage.grow_after_implicit(to.time_step, to.forward)
                            : 0;
  if (model.springs.criteria) state_->whole_review.remove_broken();
  state_->failures.collect(0);
  state_->clock.review();
  if (to.settles) state_->energy.count_halted(error - state_->energy.balance().error);
  return growth;
}

double Simulation::overshoot(const EquilibriumUpdate& to) {
  gather();
  const Clock clock = state_->clock;
  const OtherMotion motion(*this, to);
  state_->clock.jump(to.time, to.time_step);
  const double found = state_->whole_review.overshoot();
  state_->clock = clock;
  return found;
}

/// The energy of explicit steps is less than that of the velocities at the time of the
/// displacements; the energy at the start takes up the change (step.cpp).
void Simulation::begin_implicit_steps(double time_step, const std::vector<double>& velocity,
                                      const std::vector<double>& height_rate) {
  EnergyAccount& energy = state_->energy;
  const double last = state_->clock.last_step();
  if (!state_->damage.empty()) state_->damage.evaluate();  // what explicit steps dissipated
  state_->loads.leave_rest();
  if (last > 0) {
    energy.find_start();
    const RowSums sums = state_->sweeps.measure(Sweep::present(last));
    energy.shift_start(sums.kinetic_mean - sums.kinetic);
    set_velocities(velocity, height_rate);
    state_->clock.rest();
  } else if (state_->loads.start_motion(time_step)) {
    energy.forget_start();
  }
  energy.find_start();
}

SettledDamage Simulation::settle_damage(const std::vector<double>& xyz,
                                        const std::vector<double>& heights,
                                        const DamageBounds& bounds) {
  EquilibriumUpdate other;
  other.xyz = xyz;
  other.heights = heights;
  const OtherMotion motion(*this, other);
  return state_->damage.settle(bounds);
}

void Simulation::forget_damage_search() { state_->damage.forget_search(); }

}  // namespace hyperlattice
