#include <engine/diagnosis.hpp>
#include <engine/guard.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

namespace hyperlattice {

Guard::Guard(const Model& model, const Simulation& simulation)
    : model_(model), simulation_(simulation), shortest_(infinity), momentum_(model) {
  for (const NeighbourGeometry& neighbour : model.springs.neighbours)
    shortest_ = std::min(shortest_, neighbour.rest_length);
  const Listed& list = model.body.listed;
  for (const ListedSpring& spring : list.springs)
    shortest_ = std::min(shortest_, norm(list.positions[spring.b] - list.positions[spring.a]));
}

void Guard::start(const PlannedStage& stage, bool is_resumed) {
  stage_ = &stage;
  if (is_resumed) return;
  warned_ = {};
  warned_.looked = simulation_.steps();
  growth_ = {};
  momentum_.start();
}

void Guard::archive(Archive& archive) {
  archive(warned_);
  archive(growth_);
  momentum_.archive(archive);
}

double Guard::critical() const {
  const double own = model_.step_limit.time_step;
  return stage_->mass_scaling ? std::max(own, stage_->mass_scaling->time_step()) : own;
}

void Guard::check_motion(double time_step) const {
  double speed = 0;
  bool finite = true;
  simulation_.fastest(speed, finite);
  if (!finite) fail("the state is no longer finite", time_step);
  // A body may fly faster than its own waves, but no sound motion is as fast as this.
  constexpr double spacings = 100;
  // Implicit steps may be much longer than the critical one.
  const double step = std::min(time_step, critical());
  if (speed * step > spacings * model_.body.grid.spacing)
    fail("a particle moves by more than 100 lattice spacings in one step", time_step);
}

void Guard::check_approach(double time_step) const {
  const double limit = stage_->stage->approach_limit;
  double speed = 0;
  bool finite = true;
  simulation_.fastest(speed, finite);
  // Particles slower than this cannot pass through each other: the springs need not be read.
  if (!(limit > 0) || 2 * speed * time_step < limit * shortest_) return;
  const SpringExtremes state = spring_extremes(model_, simulation_, time_step);
  if (state.closing.value > limit)
    fail(fmt::format("two particles come nearer by {:.3g} of their distance in one step, and "
                     "approach_limit is {:.3g}",
                     state.closing.value, limit),
         time_step);
}

std::string Guard::early_warning(const EnergyBalance& balance, double time_step) {
  constexpr double early = 0.1;
  const double tolerance = stage_->stage->energy_tolerance;
  if (warned_.of_error != 0 || !(tolerance > 0) ||
      std::abs(balance.relative_error()) < early * tolerance)
    return {};
  warned_.of_error = 1;
  const std::string cause =
      likely_cause(model_, spring_extremes(model_, simulation_, time_step), time_step, critical());
  if (cause.empty()) return {};
  return fmt::format(
      "the error of the energy balance is {:.2g} of the largest energy at {:.6g} s. {}",
      std::abs(balance.relative_error()), simulation_.time(), cause);
}

void Guard::check_growth(const EnergyBalance& balance, const std::vector<double>& work,
                         double time_step) {
  const double limit = stage_->stage->growth_limit,
               ratio = time_step / stage_->plan.stable_time_step;
  if (!growth_.runs_away(balance, work, ratio < 1 ? ratio : 0, limit)) return;
  fail(fmt::format("energy grows from nothing: it is {:.3g} times all that the start and the loads "
                   "have put in, and growth_limit is {:.3g}. A motion is unstable: the time step "
                   "is too long for some spring or load as it is now, or a law or a load of a "
                   "plugin is wrong. Take a shorter time_step",
                   growth_.ratio(), limit),
       time_step);
}

void Guard::check_momentum(const EnergyBalance& balance, double time_step) {
  const double tolerance = stage_->stage->momentum_tolerance;
  // Added mass moves with the body, but body accelerations need not act on it.
  if (!(tolerance > 0) || simulation_.damps() || stage_->mass_scaling) return momentum_.start();
  const double error = momentum_.error_of(balance, simulation_.time());
  if (error > tolerance)
    fail(fmt::format("momentum is lost: its error is {:.3g} of the gross momentum, and "
                     "momentum_tolerance is {:.3g}. The forces of a load are not those of its "
                     "factor at the time, or forces of springs do not act and react: check loads "
                     "and laws of plugins",
                     error, tolerance),
         time_step);
}

std::string Guard::step_warning(const EnergyBalance& balance, double time_step) {
  // A look takes about a hundred steps. An error that grows is a sign that steps become too long.
  constexpr std::uint64_t every = 10000;
  constexpr double noticeable = 1e-4, grown = 10;
  const double error = std::abs(balance.relative_error());
  const bool is_due = simulation_.steps() >= warned_.looked + every ||
                      (error > noticeable && error > grown * warned_.error_looked);
  if (warned_.of_step != 0 || !(time_step < critical()) || !is_due) return {};
  warned_.looked = simulation_.steps();
  warned_.error_looked = error;
  const SpringExtremes state = spring_extremes(model_, simulation_, time_step);
  if (!(time_step > state.critical * critical())) return {};
  warned_.of_step = 1;
  return fmt::format("at {:.6g} s the time step, {:.4g} s, is longer than springs now allow. {}",
                     simulation_.time(), time_step,
                     likely_cause(model_, state, time_step, critical()));
}

void Guard::check_finite(const EnergyBalance& balance, double time_step) const {
  const double total = balance.kinetic + balance.stored + balance.dissipated() + balance.injected;
  if (!std::isfinite(total)) fail("the energy is no longer finite", time_step);
}

void Guard::check_balance(const EnergyBalance& balance, double time_step) const {
  const double tolerance = stage_->stage->energy_tolerance;
  if (tolerance > 0 && std::abs(balance.relative_error()) > tolerance)
    fail(fmt::format("the energy balance is lost: an error of {:.3g} J is {:.3g} of the largest "
                     "energy so far, {:.3g} J, and energy_tolerance is {:.3g}",
                     balance.error, std::abs(balance.relative_error()), balance.scale, tolerance),
         time_step);
}

void Guard::fail(const std::string& what, double time_step) const {
  double speed = 0;
  bool finite = true;
  const Particle particle = simulation_.fastest(speed, finite);
  const Vec3 x = model_.body.position(particle);
  const Material& material = model_.materials[model_.kinds.material(particle)];
  std::string law =
      fmt::format("{} ({})", material.stage->component->type(), material.stage->pointer);
  for (const Material::Criterion& criterion : material.failures)
    law += fmt::format("{}{}", &criterion == &material.failures.front() ? " with " : ", ",
                       criterion.stage->component->type());
  if (material.surface) law += fmt::format(", {}", material.surface->stage->component->type());
  std::string cause;
  if (finite)
    cause = likely_cause(model_, spring_extremes(model_, simulation_, time_step), time_step,
                         critical());
  if (!cause.empty()) cause = " " + cause;
  throw RunError(fmt::format(
      "step {}, t = {:.6g} s: {}. {} particle {} at ({:.4g}, {:.4g}, {:.4g}) m{}, law {}. "
      "The step was {:.4g} s, {:.3g} of the critical {:.4g} s.{}",
      simulation_.steps(), simulation_.time(), what,
      finite ? "The fastest is" : "The first bad one is", particle, x.x, x.y, x.z,
      finite ? fmt::format(" with {:.4g} m/s", speed) : std::string(), law, time_step,
      time_step / critical(), critical(), cause));
}

}  // namespace hyperlattice
