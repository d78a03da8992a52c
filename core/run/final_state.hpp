// state.bin: the state of a body at the end of a run, from which another run can start: with other
// loads, solvers and outputs, and with materials of other stiffness or strength. The body and what
// its laws and criteria keep must be the same.
#pragma once

#include <plan/plan.hpp>
#include <ranks/ranks.hpp>
#include <run/folder.hpp>
#include <state/simulation.hpp>

#include <filesystem>
#include <string>

namespace hyperlattice {

/// Writes the state into the folder of the run. All ranks must call it; the first one writes.
/// Throws OutsideError or std::runtime_error if the disk refuses.
void write_final_state(const Plan& plan, Simulation& simulation, RunFolder& folder, Ranks& ranks);

/// Reads the file of a run's folder whole, and returns what it says of the state. Throws InputError
/// if it is missing or damaged.
StartState read_start(const std::filesystem::path& directory);

/// Gives a simulation, before its first step, the state. Velocities half a step before the state
/// change so that those at the state's time stay, whatever the loads of the model are. Throws
/// std::runtime_error if the file does not fit.
void start_from(const StartState& start, const Model& model, Simulation& simulation, Ranks& ranks);

/// Returns whether the summary in a folder says that its run is done.
bool is_done(const std::filesystem::path& directory);
/// Returns how to go on from a run in a folder, if the run is done; empty if it is not.
std::string about_done_run(const std::filesystem::path& directory);

}  // namespace hyperlattice
