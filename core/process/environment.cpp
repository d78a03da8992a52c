#include <process/environment.hpp>

#include <base/errors.hpp>

#include <spdlog/fmt/fmt.h>
#include <spdlog/fmt/ranges.h>

#include <algorithm>
#include <cstdlib>

namespace hyperlattice {

namespace {

/// Adds a fault for a value that is not a whole number; the core would use its default. `what`:
/// what the seconds limit.
void check_seconds(const char* name, const char* what, Faults& faults) {
  const char* value = std::getenv(name);
  if (value == nullptr) return;
  const std::string_view text = value;
  if (text.empty()) {
    unsetenv(name);
  } else if (text.find_first_not_of("0123456789") != text.npos) {
    faults.add(name, std::string(text),
               fmt::format("in the environment, whole seconds that {}; 0: no limit", what));
  }
}

}  // namespace

void check_environment() {
  struct Variable {
    const char* name;
    std::vector<std::string> values;
  };
  static const Variable variables[] = {
      {"HYPERLATTICE_INSTRUCTIONS", {"baseline", "avx2", "avx512"}},
      {"HYPERLATTICE_SPRINGS", {"exact"}},
      {"HYPERLATTICE_PROGRESS", {"json"}}};
  Faults faults;
  for (const auto& [name, values] : variables) {
    const char* value = std::getenv(name);
    if (value == nullptr) continue;
    if (*value == '\0') {
      unsetenv(name);  // empty means unset
      continue;
    }
    if (std::find(values.begin(), values.end(), value) != values.end()) continue;
    const std::string near = nearest(value, values);
    faults.add(name, value,
               fmt::format("in the environment, {}{}", fmt::join(values, ", "),
                           near.empty() ? "" : "; did you mean '" + near + "'?"));
  }
  check_seconds("HYPERLATTICE_LOAD_SECONDS", "a plugin may take to load", faults);
  check_seconds("HYPERLATTICE_COMPILE_SECONDS", "the compilation of a plugin may take", faults);
  faults.throw_if_any();
}

}  // namespace hyperlattice
