// Estimates of the memory, disk space and time that a plan needs.
#pragma once

#include <plan/plan.hpp>
#include <state/layout.hpp>

namespace hyperlattice {

/// The number of frames that a run with several threads copies at most, so that they can be written
/// beside the next steps.
inline constexpr std::size_t queued_frames = 2;

/// Sets bytes_per_particle of the plan, and memory_bytes: of this rank, if its part is the largest.
void estimate_memory(Plan& plan);
/// Returns the bytes of a rank that has this part of the places of all blocks, 0 to 1. `writes`: it
/// is the first one.
double rank_bytes(const Plan& plan, const Layout& layout, double part, bool writes);
/// Returns why every rank gets the whole state after each step, as a clause; "" if it does not.
std::string whole_after_steps(const Plan& plan);
/// Returns why every rank holds the whole state, as a clause; "" if it does not.
std::string whole_in_ranks(const Plan& plan);
/// Returns why the first rank gets the whole state for outputs, as a clause; "" if it does not.
std::string first_needs_whole(const Plan& plan);
/// Sets output_bytes of the plan.
void estimate_output(Plan& plan);
/// Sets expected_seconds of the plan from the cost of kernels on a common server processor;
/// calibration.hpp measures this machine.
void estimate_time(Plan& plan);

/// Returns the bytes of a model.
double model_bytes(const Model& model);
/// Returns the bytes of the plan's memory that are allocated already: those of the program and the
/// model.
double allocated_bytes(const Model& model);
/// Returns the bytes of one frame of a writer with all its fields in motion: from the writer's
/// trial, else from the count of numbers.
double frame_bytes(const Plan& plan, const Stage& writer);
/// Returns how often a writer or probe is shown the body: at the start, at its intervals, at each
/// state of rest and at the end, at most once per step.
double frames_of(const Plan& plan, const Stage& output);
/// Returns the number of the stage's records in the history.
double records_of(const PlannedStage& stage);
/// Returns the seconds that all frames and records take, if a sweep over all springs takes `sweep`
/// seconds. `measured`: frames take the time of their trial on this machine.
double output_seconds(const Plan& plan, double sweep, bool measured);
/// Returns how many times longer a run may take than at rest: the criterion is asked about one
/// breaking spring at a time, and particles in contact answer each other.
double slowest(const Model& model);

}  // namespace hyperlattice
