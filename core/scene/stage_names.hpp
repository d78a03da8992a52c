// Stages by their names in "--set NAME/OPTION=VALUE".
#pragma once

#include <scene/json.hpp>

#include <string>

namespace hyperlattice {

/// The stage that a name means.
struct NamedStage {
  std::string pointer;   ///< "/pipeline/3", "/pipeline/1/failure"; empty: none, or several
  std::string expected;  ///< what was expected if there is no one stage
};

/// Finds a stage, or a failure criterion of a material, by the stage's `name`, or by its type if
/// only one has this type.
NamedStage find_stage(const Json& scene, const std::string& name);

}  // namespace hyperlattice
