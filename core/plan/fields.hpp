// Which fields of the body a run has, and which its outputs ask for.
#pragma once

#include <model/model.hpp>

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace hyperlattice {

/// Whether a run has the field: no height without a membrane that moves, nothing broken without a
/// failure law.
bool has_field(const Model& model, std::string_view name);

/// The fields that each writer and probe names in any of its options.
using AskedFields = std::map<const Stage*, std::vector<std::string>>;
AskedFields asked_fields(const Scene& scene);

}  // namespace hyperlattice
