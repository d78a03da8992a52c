// Criteria that decide about all springs at once (array_failure.hpp).
#pragma once

#include <model/material.hpp>
#include <scene/scene.hpp>

#include <hyperlattice/array_failure.hpp>

#include <algorithm>

namespace hyperlattice {

/// Returns the functions of a criterion that decides about all springs at once; null: it decides
/// about each spring alone.
inline const ArrayFailureFunctions* array_functions(const Material::Criterion& criterion) {
  return criterion.stage->component->info.functions_size == sizeof(ArrayFailureFunctions)
             ? &criterion.stage->functions<ArrayFailureFunctions>()
             : nullptr;
}

/// Returns whether a material has such a criterion.
inline bool has_array_criterion(const Material& material) {
  return std::any_of(
      material.failures.begin(), material.failures.end(),
      [](const Material::Criterion& criterion) { return array_functions(criterion) != nullptr; });
}

}  // namespace hyperlattice
