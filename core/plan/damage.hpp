// What the plan says about fields of damage: their lengths, and what a crack in this body lacks.
#pragma once

#include <plan/plan.hpp>

namespace hyperlattice {

/// Returns an entry for each material with a strength surface.
nlohmann::json damage_json(const Model& model);
/// Returns names and values as texts, from an entry of damage_json().
std::vector<std::pair<std::string, std::string>> damage_lines(const nlohmann::json& entry);

/// Adds warnings to the model for lengths and boundaries with which cracks are less exact.
void warn_of_damage(Plan& plan);

}  // namespace hyperlattice
