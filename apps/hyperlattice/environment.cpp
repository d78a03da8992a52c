#include "environment.hpp"

#include <base/errors.hpp>

#include <spdlog/fmt/fmt.h>
#include <spdlog/fmt/ranges.h>

#include <algorithm>
#include <cstdlib>

namespace hyperlattice {

void check_environment() {
  struct Variable {
    const char* name;
    std::vector<std::string> values;
  };
  static const Variable variables[] = {
      {"HYPERLATTICE_INSTRUCTIONS", {"baseline", "avx2", "avx512"}}, {"HYPERLATTICE_SPRINGS", {"exact"}}, {"HYPERLATTICE_PROGRESS", {"json"}}};
  Faults faults;
  for (const auto& [name, values] : variables) {
    const char* value = std::getenv(name);
    if (value == nullptr) continue;
    if (*value == '\0') {
      unsetenv(name);  // as shells leave it
      continue;
    }
    if (std::find(values.begin(), values.end(), value) != values.end()) continue;
    const std::string near = nearest(value, values);
    faults.add(name, value, fmt::format("in the environment, {}{}", fmt::join(values, ", "), near.empty() ? "" : "; did you mean '" + near + "'?"));
  }
  faults.throw_if_any();
}

}  // namespace hyperlattice
