// The fields that a run has, and those that its outputs ask for.
#pragma once

#include <base/errors.hpp>
#include <model/model.hpp>

#include <hyperlattice/field_table.hpp>

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace hyperlattice {

/// Returns a field of field_table or one that a law of the body gives; null if there is none.
const FieldInfo* field_of(const Model& model, std::string_view name);
/// Returns the names of all fields that a run has.
std::vector<std::string_view> fields_of(const Model& model);

/// Returns whether a run has the field: heights need a free membrane, broken springs and damage
/// need a failure criterion, a source needs a listed body.
bool has_field(const Model& model, std::string_view name);

/// Returns whether a field is computed from the forces or the motion of all springs.
bool is_measured(std::string_view name);

/// Returns whether a field follows from the displacement, velocity or height of each particle by
/// itself, or does not change.
bool is_of_particle(std::string_view name);

/// For each writer and probe, the fields that any of its options names.
using AskedFields = std::map<const Stage*, std::vector<std::string>>;
AskedFields asked_fields(const Scene& scene);

/// Adds a fault for each place where an output names a field that the run does not have.
void check_fields(const Model& model, Faults& faults);

}  // namespace hyperlattice
