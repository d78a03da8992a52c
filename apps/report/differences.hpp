// In what scenes differ.
#pragma once

#include <scene/json.hpp>

#include <span>
#include <string>
#include <vector>

namespace hyperlattice::report {

struct Difference {
  std::string pointer;       ///< JSON pointer
  std::vector<Json> values;  ///< one a scene; null if it has none there
};

/// The innermost places at which not all scenes have the same. Of what one of them lacks, or has as
/// another type of stage, the whole is one difference. Scenes that are null are not compared.
std::vector<Difference> differences(const std::vector<Json>& scenes);

}  // namespace hyperlattice::report
