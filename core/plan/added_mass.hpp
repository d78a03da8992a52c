// Added mass in the plan: whether a stage may have it, and what it changes.
#pragma once

#include <base/errors.hpp>
#include <plan/plan.hpp>

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace hyperlattice {

/// Finds the mass that a stage adds (its option `mass_scaling`), before the solver plans. Adds a
/// fault if the body does not allow it.
void add_mass(PlannedStage& planned, const Model& model, Faults& faults);
/// Adds a fault if the solver's steps are not such that added mass lengthens them.
void check_added_mass(const PlannedStage& planned, Faults& faults);

/// Returns a warning if a stage without damping adds so much mass that it changes the motion of the
/// whole body; empty otherwise.
std::string added_mass_warning(const PlannedStage& planned);

/// Returns the entry `added_mass` of a stage in plan and summary.
nlohmann::json added_mass_json(const MassScaling& scaling, const Model& model);
/// Returns what the mass is and changes, in a sentence for the plan.
std::string added_mass_text(const MassScaling& scaling, const Model& model);

}  // namespace hyperlattice
