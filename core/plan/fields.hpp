// Which fields of the body a run has, and which its outputs ask for.
#pragma once

#include <model/model.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace hyperlattice {

/// Whether a run has the field: no height without a membrane that moves, nothing broken without a failure law.
bool has_field(const Model& model, std::string_view name);

/// The fields that a writer or probe names in any of its options.
std::vector<std::string> asked_fields(const Scene& scene, const Stage& output);

}  // namespace hyperlattice
