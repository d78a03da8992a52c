// The differences between scenes.
#pragma once

#include <scene/json.hpp>

#include <span>
#include <string>
#include <vector>

namespace hyperlattice::report {

struct Difference {
  std::string pointer;       ///< JSON pointer
  std::vector<Json> values;  ///< one for each scene; null if the scene has none at this place
};

/// Returns the innermost places at which not all scenes are equal. A part that one scene lacks, or
/// that has another type of stage there, is one difference as a whole. Null scenes are not
/// compared.
std::vector<Difference> differences(const std::vector<Json>& scenes);

}  // namespace hyperlattice::report
