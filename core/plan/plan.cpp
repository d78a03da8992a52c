#include <base/errors.hpp>
#include <model/build.hpp>
#include <plan/fields.hpp>
#include <plan/file_names.hpp>
#include <plan/left_out.hpp>
#include <plan/plan.hpp>
#include <plan/precision.hpp>
#include <plan/rehearsal.hpp>
#include <plan/resolution.hpp>
#include <run/layout.hpp>
#include <run/stage_calls.hpp>
#include <scene/stage_call.hpp>

#include <hyperlattice/output.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <new>

namespace hyperlattice {

namespace {

/// The core counts steps and bytes by these numbers.
void check_plan(const Stage& stage, const PlannedStage& planned) {
  const SolverPlan& plan = planned.plan;
  const auto counts = [](double number) { return std::isfinite(number) && number >= 0; };
  if (!std::isfinite(plan.end_time) || plan.end_time < planned.start_time)
    throw plugin_error(stage, "plan", fmt::format("it ends at {} s and starts at {} s", plan.end_time, planned.start_time));
  if (!counts(plan.time_step) || (plan.time_step == 0 && !plan.at_rest) || !counts(plan.damping) || !counts(plan.bytes_per_site) ||
      !counts(plan.sweeps_per_step) || std::isnan(plan.stable_time_step))
    throw plugin_error(stage, "plan", fmt::format("it gives a time step of {} s, or another number that is negative or not finite", plan.time_step));
}

/// Each stage starts where the one before ends.
void plan_stages(Plan& plan, Faults& faults) {
  double start = 0;
  for (const Stage* stage : plan.scene->of(Family::solvers)) {
    PlannedStage planned;
    planned.stage = stage;
    planned.component = make_component(*stage);
    planned.start_time = start;
    const SolverFacts facts = solver_facts(*plan.model, start);
    const auto refused = refusal_of(*stage, "plan", [&](const Complaint& why) {
      return stage->functions<SolverFunctions>().plan(planned.component.get(), facts, planned.plan, why);
    });
    if (refused)
      add_all(faults, objection(*plan.scene, *stage, *refused));
    else
      check_plan(*stage, planned);
    if (!refused) start = planned.plan.end_time;
    plan.stages.push_back(std::move(planned));
  }
}

/// Refuses outputs of fields that the run does not have, before anything is written.
void check_fields(const Plan& plan, Faults& faults) {
  std::vector<std::string_view> present;
  for (const std::string_view name : field_names)
    if (has_field(*plan.model, name)) present.push_back(name);
  for (const Family family : {Family::writers, Family::probes})
    for (const Stage* stage : plan.scene->of(family))
      for (const std::string& name : asked_fields(*plan.scene, *stage))
        if (!has_field(*plan.model, name)) faults.add(stage->pointer, name, fmt::format("fields that this run has: {}", fmt::join(present, ", ")));
}

/// Numbers a particle that the asked fields hold.
double numbers_per_particle(const Scene& scene, const Stage& output) {
  double numbers = 0;
  for (const std::string& name : asked_fields(scene, output)) numbers += name == "displacement" || name == "velocity" ? 3 : 1;
  return numbers;
}

double frames_of(const Stage& output, double end_time) {
  const double every = output_interval(output, end_time);
  return every > 0 ? std::floor(end_time / every) + 1 : 2;
}

double records_of(const PlannedStage& stage) {
  if (stage.plan.at_rest) {
    const std::uint64_t whole = stage.plan.steps / record_steps(stage);
    return static_cast<double>(whole) + 1;
  }
  return std::min((stage.plan.end_time - stage.start_time) / record_interval(stage), static_cast<double>(stage.plan.steps)) + 1;
}

void estimate_memory(Plan& plan) {
  const Model& model = *plan.model;
  const double particles = static_cast<double>(model.body.particles);
  const std::unique_ptr<Layout> layout = make_layout(model, plan.threads);
  plan.bytes_per_particle = layout->state_bytes() / particles;

  const std::size_t runs = model.body.runs.size() + model.body.cells.runs().size();
  double model_bytes =
      static_cast<double>(model.body.listed.springs.size() * sizeof(ListedSpring) + model.body.listed.positions.size() * sizeof(Vec3) +
                          runs * sizeof(Run) + model.body.row_runs.size() * sizeof(std::size_t) + model.material_of.size()) +
      model.mixtures.bytes();
  for (const Load& load : model.loads)
    model_bytes += static_cast<double>(load.particles.size() * (sizeof(LoadedParticle) + sizeof(Support)) +
                                       load.watched.size() * (sizeof(WatchedParticle) + sizeof(Support) + 2 * sizeof(Vec3)));
  for (const BlockLayout& block : layout->blocks) model_bytes += static_cast<double>(block.rows.size() * 2 * sizeof(Row));

  double output_numbers = 0;  // positions, and the fields of the most demanding output
  for (const Family family : {Family::writers, Family::probes})
    for (const Stage* stage : plan.scene->of(family)) output_numbers = std::max(output_numbers, 3 + numbers_per_particle(*plan.scene, *stage));
  double solver_bytes = 0;
  for (const PlannedStage& stage : plan.stages) solver_bytes = std::max(solver_bytes, stage.plan.bytes_per_site);
  const Site low = model.body.low, high = model.body.high;
  solver_bytes *= model.body.is_listed() ? particles : (high.i - low.i + 1.0) * (high.j - low.j + 1.0) * (high.k - low.k + 1.0);
  plan.memory_bytes = solver_bytes + layout->state_bytes() + layout->scratch_bytes() + model_bytes + output_numbers * sizeof(double) * particles;
}

void estimate_output(Plan& plan) {
  constexpr double bytes_per_number = 4.5, bytes_per_text_number = 19, history_numbers = 16;
  const double particles = static_cast<double>(plan.model->body.particles);
  for (const Stage* stage : plan.scene->of(Family::writers))
    plan.output_bytes += frames_of(*stage, plan.end_time()) * particles * (3 + numbers_per_particle(*plan.scene, *stage)) * bytes_per_number;
  for (const Stage* stage : plan.scene->of(Family::probes))
    plan.output_bytes += frames_of(*stage, plan.end_time()) * (1 + std::max(1.0, numbers_per_particle(*plan.scene, *stage))) * bytes_per_text_number;
  for (const PlannedStage& stage : plan.stages) {
    plan.output_bytes += records_of(stage) * history_numbers * bytes_per_text_number;
  }
}

/// From what the kernels take on one core of a common server processor (docs: performance); another machine may differ by a factor of two.
void estimate_time(Plan& plan) {
  constexpr double baseline = 4, avx2 = 1.4, avx512 = 0.9;  // ns a base spring and step
  constexpr double fourth_dimension = 1.8, damped = 1.1, floats = 0.6, listed = 4, second_thread = 0.6;
  const Model& model = *plan.model;
  const std::string_view instructions = model.kernels.instructions;
  double spring = instructions == "avx512" ? avx512 : instructions == "avx2" ? avx2 : baseline;
  if (model.degrees_of_freedom == 4) spring *= fourth_dimension;
  if (model.body.is_listed()) spring *= listed;
  if (model.choice.precision == Precision::floats) spring *= floats;
  const double step = 1e-9 * spring * static_cast<double>(model.body.base_springs()) / (1 + second_thread * (plan.threads - 1));
  for (const PlannedStage& stage : plan.stages)
    plan.expected_seconds +=
        step * (static_cast<double>(stage.plan.steps) * stage.plan.sweeps_per_step * (stage.plan.damping > 0 ? damped : 1) + records_of(stage));
}

}  // namespace

std::uint64_t Plan::steps() const {
  std::uint64_t steps = 0;
  for (const PlannedStage& stage : stages) steps += stage.plan.steps;
  return steps;
}

double Plan::end_time() const { return stages.empty() ? 0 : stages.back().plan.end_time; }

double output_interval(const Stage& output, double end_time) {
  constexpr double frames = 20, samples = 200;
  return output.cadence.every.value_or(end_time / (output.family() == Family::writers ? frames : samples));
}

double record_interval(const PlannedStage& stage) {
  constexpr double records = 200, steps = 10;  // a record costs as much as a step
  if (stage.stage->record_every > 0) return stage.stage->record_every;
  return std::max((stage.plan.end_time - stage.start_time) / records, steps * stage.plan.time_step);
}

std::uint64_t record_steps(const PlannedStage& stage) { return std::max<std::uint64_t>(1, stage.plan.time_step > 0 ? stage.plan.steps / 200 : 1); }

std::unique_ptr<Plan> make_plan(std::unique_ptr<Scene> scene, int threads) {
  const auto start = std::chrono::steady_clock::now();
  auto plan = std::make_unique<Plan>();
  plan->scene = std::move(scene);
  plan->threads = threads;
  try {
    plan->model = build_model(*plan->scene);
  } catch (const std::bad_alloc&) {
    throw OutsideError("out of memory while the lattice was built: too many particles for this machine");
  }
  plan->body = body_figures(*plan->model);
  for (std::string& warning : size_warnings(plan->body, plan->model->body.grid.spacing)) plan->model->warnings.push_back(std::move(warning));
  Faults faults;
  plan_stages(*plan, faults);
  check_fields(*plan, faults);
  check_file_names(*plan->scene, faults);
  if (faults.empty()) check_precision(*plan, faults);
  if (faults.empty()) check_resolution(*plan, faults);
  if (faults.empty()) rehearse_outputs(*plan, faults);
  faults.throw_if_any();
  estimate_memory(*plan);
  estimate_output(*plan);
  estimate_time(*plan);
  plan->left_out = left_out(*plan);
  plan->setup_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return plan;
}

}  // namespace hyperlattice
