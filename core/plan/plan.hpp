// The plan: what a run will load, allocate and compute, and what it leaves out; known before
// anything is computed.
#pragma once

#include <model/body_figures.hpp>
#include <model/mass_scaling.hpp>
#include <plan/fields.hpp>
#include <plan/identity.hpp>
#include <plan/start_state.hpp>
#include <plan/threads.hpp>
#include <ranks/ranks.hpp>

#include <hyperlattice/solver.hpp>

#include <nlohmann/json_fwd.hpp>

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace hyperlattice {

struct LeftOut {
  std::string what, why;
};

/// One solver stage, planned.
struct PlannedStage {
  const Stage* stage = nullptr;
  ComponentPointer component;
  double start_time = 0;
  SolverPlan plan;
  std::optional<MassScaling> mass_scaling;  ///< the mass that the stage adds, if it does
};

/// The table that a probe will write.
struct PlannedTable {
  std::string probe;  ///< its stage's name
  std::vector<std::string> columns;
};

/// What a writer or probe asks of the state, as its begin() tells.
struct OutputNeeds {
  std::set<std::string, std::less<>> fields;
  /// It asks for more than fields that follow from the motion of each particle, or named none.
  bool state = true;
};

/// The cost of a writer's frame when the body moves, from frames of a few of its particles.
struct FrameCost {
  double bytes = 0, seconds = 0;
};

struct Plan {
  std::unique_ptr<Scene> scene;
  Identity identity;  ///< of the run, at the time of planning
  std::unique_ptr<Model> model;
  BodyFigures body;  ///< its size and mass as built
  std::vector<PlannedStage> stages;
  AskedFields asked_fields;
  std::vector<PlannedTable> tables;               ///< in the order of the scene's probes
  std::map<const Stage*, FrameCost> frame_costs;  ///< of the writers that could be tried
  std::map<const Stage*, double> writer_bytes;    ///< of memory, of the writers that state it
  std::unique_ptr<Ranks> alone;   ///< of a run in this process; outlives its simulation
  int ranks = 1;                  ///< processes of the run
  bool writes = true;             ///< whether this is the rank with the outputs
  int threads = 1;                ///< of each rank
  int blocks = 1;                 ///< of the state, in all ranks together
  double bytes_per_particle = 0;  ///< of the state that the kernel works on
  double memory_bytes = 0;        ///< that this process needs
  double output_bytes = 0;        ///< estimated
  double setup_seconds = 0;       ///< spent on building the model
  double expected_seconds = 0;    ///< estimated from the kernel's cost on a common machine
  std::vector<LeftOut> left_out;
  AskedFields used_fields;                    ///< of each writer: fields that it names in begin()
  std::map<const Stage*, OutputNeeds> needs;  ///< of the outputs; only if this rank writes
  std::optional<StartState> start;            ///< none: the run starts from the body at rest

  std::uint64_t steps() const;
  double end_time() const;
  double start_time() const { return start ? start->time : 0; }
  /// Returns the number of steps that the state at the start has behind it.
  std::uint64_t first_step() const { return start ? start->steps : 0; }
};

/// Validates everything and writes nothing. Throws as read_scene and build_model do, and InputError
/// if a solver refuses its time step, or if `start` is the state of another body. `threads`: of
/// each rank. `writes`: whether outputs are tried; of the ranks of a run only the first one does.
std::unique_ptr<Plan> make_plan(std::unique_ptr<Scene> scene, Threads threads, int ranks = 1,
                                std::optional<StartState> start = {}, bool writes = true);

/// Sets another number of threads of each rank, with a block of the state for each thread, and
/// repeats the estimates that depend on it.
void set_threads(Plan& plan, int threads);
/// Sets the number of blocks of a run that is resumed, and as many threads as they need.
void set_blocks(Plan& plan, int blocks);

/// Returns the seconds between the outputs of a writer or probe in a run of `duration` seconds. By
/// default a run has 20 frames of a writer and 200 samples of a probe.
double output_interval(const Stage& output, double duration);

/// Returns the seconds between the records of a stage's history; by default a stage has at most 200
/// records.
double record_interval(const PlannedStage& stage);
/// Returns the steps between the records of a stage that looks for rest.
std::uint64_t record_steps(const PlannedStage& stage);

/// Returns the plan as text for people.
std::string plan_text(const Plan& plan);
/// Returns the keys of summary.json that are known before a run, and `left_out`.
nlohmann::json plan_json(const Plan& plan);

}  // namespace hyperlattice
