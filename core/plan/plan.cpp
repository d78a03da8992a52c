#include <base/errors.hpp>
#include <model/build.hpp>
#include <plan/added_mass.hpp>
#include <plan/coordination.hpp>
#include <plan/damage.hpp>
#include <plan/estimates.hpp>
#include <plan/fields.hpp>
#include <plan/file_names.hpp>
#include <plan/idle_loads.hpp>
#include <plan/left_out.hpp>
#include <plan/output_trial.hpp>
#include <plan/plan.hpp>
#include <plan/precision.hpp>
#include <plan/resolution.hpp>
#include <plan/solver_facts.hpp>
#include <process/lack_of_memory.hpp>
#include <scene/stage_call.hpp>

#include <hyperlattice/output.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <new>

namespace hyperlattice {

namespace {

/// Checks the numbers of a solver's plan, by which the core counts steps and bytes.
void check_plan(const Stage& stage, const PlannedStage& planned) {
  const SolverPlan& plan = planned.plan;
  const auto counts = [](double number) { return std::isfinite(number) && number >= 0; };
  if (!std::isfinite(plan.end_time) || plan.end_time < planned.start_time)
    throw plugin_error(
        stage, "plan",
        fmt::format("it ends at {} s and starts at {} s", plan.end_time, planned.start_time));
  if (!counts(plan.time_step) || (plan.time_step == 0 && !plan.at_rest) || !counts(plan.damping) ||
      !counts(plan.bytes_per_site) || !counts(plan.sweeps_per_step) ||
      std::isnan(plan.stable_time_step))
    throw plugin_error(
        stage, "plan",
        fmt::format(
            "it gives a time step of {} s, or another number that is negative or not finite",
            plan.time_step));
}

/// Plans the stages. Each one starts at the time at which the one before ends.
void plan_stages(Plan& plan, Faults& faults) {
  double start = plan.start_time();
  for (const Stage* stage : plan.scene->of(Family::solvers)) {
    PlannedStage planned;
    planned.stage = stage;
    planned.component = make_component(*stage);
    planned.start_time = start;
    SolverFacts facts = solver_facts(*plan.model, start);
    add_mass(planned, *plan.model, faults);
    if (planned.mass_scaling)
      facts.critical_time_step =
          std::max(facts.critical_time_step, planned.mass_scaling->time_step());
    const auto refused = refusal_of(*stage, "plan", [&](const Complaint& why) {
      return stage->functions<SolverFunctions>().plan(planned.component.get(), facts, planned.plan,
                                                      why);
    });
    if (refused)
      add_all(faults, objection(*plan.scene, *stage, *refused));
    else
      check_plan(*stage, planned);
    if (!refused) check_added_mass(planned, faults);
    if (std::string warning = added_mass_warning(planned); !warning.empty())
      plan.model->warnings.push_back(std::move(warning));
    const bool is_static = planned.plan.at_rest && planned.plan.time_step == 0;
    if (!refused && is_static && facts.damages && !planned.plan.grows_damage)
      faults.add(
          stage->pointer, stage->component->type(),
          "a solver that lets damage grow between states of rest, or one that steps in time");
    if (!refused) start = planned.plan.end_time;
    plan.stages.push_back(std::move(planned));
  }
}

}  // namespace

std::uint64_t Plan::steps() const {
  std::uint64_t steps = 0;
  for (const PlannedStage& stage : stages) steps += stage.plan.steps;
  return steps;
}

double Plan::end_time() const {
  return stages.empty() ? start_time() : stages.back().plan.end_time;
}

double output_interval(const Stage& output, double duration) {
  constexpr double frames = 20, samples = 200;
  return output.cadence.every.value_or(duration /
                                       (output.family() == Family::writers ? frames : samples));
}

double record_interval(const PlannedStage& stage) {
  constexpr double records = 200, steps = 10;  // a record costs as much as a step
  if (stage.stage->record_every > 0) return stage.stage->record_every;
  return std::max((stage.plan.end_time - stage.start_time) / records, steps * stage.plan.time_step);
}

std::uint64_t record_steps(const PlannedStage& stage) {
  return std::max<std::uint64_t>(1, stage.plan.time_step > 0 ? stage.plan.steps / 200 : 1);
}

void set_threads(Plan& plan, int threads) {
  plan.threads = threads;
  plan.blocks = threads * plan.ranks;
  estimate_memory(plan);
  estimate_time(plan);
}

void set_blocks(Plan& plan, int blocks) {
  plan.threads = (blocks + plan.ranks - 1) / plan.ranks;
  plan.blocks = blocks;
  estimate_memory(plan);
  estimate_time(plan);
}

namespace {

/// Plans all but the scene and the ranks.
void fill(Plan& plan, Threads threads) {
  plan.identity = identity_of(*plan.scene);
  if (plan.start)
    plan.identity.push_back({Dependence::Kind::file, "--from", plan.start->file, plan.start->hash});
  try {
    plan.model = build_model(*plan.scene);
  } catch (const std::bad_alloc&) {
    throw OutsideError(
        "out of memory while the lattice was built: too many particles for this machine; " +
        lack_of_memory());
  }
  std::vector<std::string>& warnings = plan.model->warnings;
  warnings.insert(warnings.begin(), plan.scene->warnings.begin(), plan.scene->warnings.end());
  plan.body = body_figures(*plan.model);
  for (std::string& warning : size_warnings(plan.body, plan.model->body.grid.spacing))
    warnings.push_back(std::move(warning));
  if (std::string warning = loose_warning(plan.model->body, plan.body.parts); !warning.empty())
    warnings.push_back(std::move(warning));
  warn_of_damage(plan);
  if (plan.model->body.is_listed())
    if (std::string warning = coordination_warning(plan.model->body); !warning.empty())
      warnings.push_back(std::move(warning));
  Faults faults;
  if (plan.start) {
    check_start(*plan.start, *plan.model, faults);
    if (!plan.model->loads.start_velocities.empty())
      warnings.push_back(
          "the velocities that loads give the body at the start have no effect: the run starts "
          "from a state with velocities of its own");
  }
  plan.asked_fields = asked_fields(*plan.scene);
  plan_stages(plan, faults);
  check_fields(*plan.model, faults);
  check_file_names(*plan.scene, faults);
  if (faults.empty()) check_precision(plan, faults);
  if (faults.empty()) check_resolution(plan, faults);
  if (faults.empty() && !plan.stages.empty()) warn_of_idle_loads(plan);
  if (plan.writes) try_outputs(plan, faults);
  faults.throw_if_any();
  estimate_output(plan);
  set_threads(plan, threads.of(plan.model->body.particles));
  plan.left_out = left_out(plan);
}

}  // namespace

std::unique_ptr<Plan> make_plan(std::unique_ptr<Scene> scene, Threads threads, int ranks,
                                std::optional<StartState> start_state, bool writes) {
  const auto start = std::chrono::steady_clock::now();
  auto plan = std::make_unique<Plan>();
  plan->scene = std::move(scene);
  plan->ranks = ranks;
  plan->start = std::move(start_state);
  plan->writes = writes;
  try {
    fill(*plan, threads);
  } catch (const InputError& error) {
    throw plan->scene->origins.with_places(error);
  }
  plan->setup_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return plan;
}

}  // namespace hyperlattice
