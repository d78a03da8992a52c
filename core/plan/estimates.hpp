// What a plan will take: memory, disk, time.
#pragma once

#include <plan/plan.hpp>

namespace hyperlattice {

void estimate_memory(Plan& plan);
void estimate_output(Plan& plan);
/// From what kernels take on a common server processor; see calibration.hpp for this one.
void estimate_time(Plan& plan);

/// Bytes of the plan's memory that stand already: the model.
double model_bytes(const Model& model);
/// Bytes of one frame of a writer, all its fields in motion: as the writer's trial says, else from
/// the count of numbers.
double frame_bytes(const Plan& plan, const Stage& writer);
/// How often a writer or probe will be shown the body: at the start, at its intervals, at each
/// state of rest and at the end, at most once a step.
double frames_of(const Plan& plan, const Stage& output);
double records_of(const PlannedStage& stage);  ///< of the history
/// Seconds that all frames and records take, if a sweep over all springs takes `sweep`. `measured`:
/// frames take what their trial took here.
double output_seconds(const Plan& plan, double sweep, bool measured);
/// How many times longer a run may take than at rest: springs that break are asked about one at a
/// time, and particles that touch answer each other.
double slowest(const Model& model);

}  // namespace hyperlattice
