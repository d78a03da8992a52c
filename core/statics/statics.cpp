#include <base/errors.hpp>
#include <host/plugin_call.hpp>
#include <process/thread_trial.hpp>
#include <state/damage_field.hpp>
#include <statics/statics.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace hyperlattice {

Statics::Statics(const Model& model, Simulation& simulation, Search search, double start,
                 double end, int threads)
    : model_(model), simulation_(simulation), start_(start), end_(end) {
  problem_.grid.inertia = search == Search::motion;
  problem_.grid.tears = !problem_.grid.inertia && model.springs.criteria;
  problem_.grid.listed = model.body.is_listed();
  if (problem_.grid.listed)
    make_list();
  else
    make_grid();
  // Places; with fewer, threads would wait for each other longer than they work.
  const std::int64_t few = problem_.grid.listed ? 4096 : 65536;
  problem_.grid.threads = problem_.grid.places < few ? 1 : threads;
  if (problem_.grid.threads > 1) try_openmp_threads(problem_.grid.threads);
  read_springs();
  state_.assign(problem_.grid.numbers(), 0);
  force_.assign(problem_.grid.numbers(), 0);
  read_state(state_.data());
  respond(state_.data(), force_.data(), nullptr);
  find_loaded();
  if (!problem_.grid.inertia) make_loads();

  problem_.self = this;
  problem_.state = state_.data();
  problem_.respond_to = [](void* self, const double* u, double* force,
                           const SpringTangents* tangents) noexcept {
    return PluginCall::answer(
        0.0, [&] { return static_cast<const Statics*>(self)->respond(u, force, tangents); });
  };
  problem_.load_at = [](void* self, double share, double* force) noexcept {
    PluginCall::answer([&] {
      const auto& statics = *static_cast<const Statics*>(self);
      statics.problem_.grid.inertia ? statics.add_step_loads(force)
                                    : statics.add_loads(share, force);
    });
  };
  problem_.prescribe_at = [](void* self, double share, double* u) noexcept {
    PluginCall::answer([&] {
      const auto& statics = *static_cast<const Statics*>(self);
      statics.problem_.grid.inertia ? statics.prescribe_mean(u) : statics.prescribe(share, u);
    });
  };
  problem_.scale_of = [](void* self, const double* internal, const double* external) noexcept {
    return PluginCall::answer(0.0, [&] {
      auto& statics = *static_cast<Statics*>(self);
      return statics.moves() ? statics.motion_scale(external)
                             : statics.force_scale(internal, external);
    });
  };
  problem_.begin_step_of = [](void* self, const TimeStep& step) noexcept {
    PluginCall::answer([&] { static_cast<Statics*>(self)->begin_step(step); });
  };
  problem_.hold_with = [](void* self, double stiffness) noexcept {
    static_cast<Statics*>(self)->hold_ = stiffness;
  };
  problem_.overshoot_at = [](void* self, double share, const double* displacement) noexcept {
    return PluginCall::answer(
        -1.0, [&] { return static_cast<Statics*>(self)->overshoot(share, displacement); });
  };
  problem_.damages = !model_.cohesive.empty();
  problem_.grow_damage_at = [](void* self, const double* displacement,
                               const DamageSearch& search) noexcept {
    return PluginCall::answer(DamageFound{}, [&] {
      return static_cast<Statics*>(self)->grow_damage(displacement, search);
    });
  };
  problem_.restore_damage_at = [](void* self) noexcept {
    PluginCall::answer([&] { static_cast<Statics*>(self)->restore_damage(); });
  };
  problem_.places_in = [](void* self, RegionId region) noexcept {
    return PluginCall::answer(std::span<const std::int64_t>(),
                              [&] { return static_cast<Statics*>(self)->places_in(region); });
  };
  problem_.position_of = [](void* self, std::int64_t place) noexcept {
    const auto& statics = *static_cast<const Statics*>(self);
    const StaticGrid& grid = statics.problem_.grid;
    if (grid.listed) return statics.model_.body.position(static_cast<Particle>(place));
    const Site low = statics.model_.body.low;
    const std::int64_t from = place - grid.origin;
    return statics.model_.body.position(
        Site{static_cast<std::int32_t>(from % grid.plane % grid.row) + low.i,
             static_cast<std::int32_t>(from % grid.plane / grid.row) + low.j,
             static_cast<std::int32_t>(from / grid.plane) + low.k});
  };
}

/// Reads which springs are there and which are soft.
void Statics::read_springs() {
  broken_ = simulation_.broken();
  soft_.clear();
  if (problem_.grid.listed)
    find_listed_weights();
  else
    make_weights();
  take_soft(simulation_.soft_springs(), simulation_.soft_particles(), simulation_.soft_cells());
}

EquilibriumUpdate Statics::rest_at(double share, const double* displacement) const {
  EquilibriumUpdate to;
  to.time = share == 1 ? end_ : start_ + share * (end_ - start_);
  to.xyz = of_particles(displacement, 0, 3);
  if (problem_.grid.components == 4) to.heights = of_particles(displacement, 3, 1);
  return to;
}

double Statics::overshoot(double share, const double* displacement) {
  if (!model_.springs.criteria) return -1;
  if (!moves()) return simulation_.overshoot(rest_at(share, displacement));
  Values after, speed;
  return simulation_.overshoot(end_of_step(displacement, after, speed));
}

/// Takes over the update, and what broke in it.
void Statics::apply(const EquilibriumUpdate& to) {
  const auto before = static_cast<std::ptrdiff_t>(simulation_.breakages().size());
  problem_.growth = simulation_.apply_equilibrium(to);
  const std::vector<Breakage>& all = simulation_.breakages();
  // A spring that its law or damage has softened away carries nothing already.
  problem_.broke = static_cast<std::uint64_t>(std::count_if(
      all.begin() + before, all.end(), [](const Breakage& one) { return !one.softened; }));
  if (problem_.broke > 0 || (problem_.damages && to.time_step == 0))
    read_springs();
  else if (problem_.damages)
    restore_damage();
}

void Statics::accept(double share, const double* displacement) {
  Values force(force_.size());
  respond(displacement, force.data(), nullptr);
  EquilibriumUpdate to = rest_at(share, displacement);
  to.settles = problem_.broke > 0;
  to.force = of_particles(force.data(), 0, 3);
  to.force_before = of_particles(force_.data(), 0, 3);
  to.factor = factors(share);
  to.factor_before = factors(share_);
  to.gravity = (1 - share) * gravity_start_ + share;
  to.gravity_before = (1 - share_) * gravity_start_ + share_;
  for (std::size_t n = 0; n < holding_.size() && !to.settles; ++n)
    to.dissipated -= (1 - 0.5 * (share_ + share)) * holding_[n] * (displacement[n] - state_[n]);
  apply(to);
  std::copy_n(displacement, state_.size(), state_.begin());
  force_ = std::move(force);
  if (problem_.broke > 0) respond(state_.data(), force_.data(), nullptr);
  share_ = share;
}

/// Passes to `visit` all that stays between searches for rest, besides the state of the simulation.
template <class Visit>
void Statics::for_rest_memory(const Visit& visit) {
  auto broke = static_cast<double>(problem_.broke);
  double compared = compared_ ? 1 : 0;
  for (double* const number :
       {&share_, &largest_scale_, &preload_, &gravity_start_, &slowest_, &broke, &compared})
    visit(*number);
  problem_.broke = static_cast<std::uint64_t>(broke);
  compared_ = compared > 0;
  for (double& factor : factor_start_) visit(factor);
  for (Held& held : held_)
    for (double(*const values)[3] : {&held.from, &held.to})
      for (double& value : *values) visit(value);
  for (Values* const field : {&state_, &force_, &holding_})
    for (double& value : *field) visit(value);
}

std::vector<double> Statics::memory() {
  if (problem_.grid.inertia) return motion_memory();
  std::vector<double> all;
  for_rest_memory([&](double value) { all.push_back(value); });
  return all;
}

void Statics::recall(std::span<const double> memory) {
  if (problem_.grid.inertia) return recall_motion(memory);
  std::size_t wanted = 0;
  for_rest_memory([&](double) { ++wanted; });
  if (memory.size() != wanted) throw std::runtime_error("the checkpoint is of another body");
  const double* from = memory.data();
  for_rest_memory([&](double& value) { value = *from++; });
}

}  // namespace hyperlattice
