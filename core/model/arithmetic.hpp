// The arithmetic of springs in kernels: by series where these are exact to round-off, or everywhere
// by roots and divisions. The environment variable HYPERLATTICE_SPRINGS=exact chooses the latter;
// tests use it as their reference.
#pragma once

#include <cstdlib>
#include <string_view>

namespace hyperlattice {

inline bool asked_for_exact_springs() {
  const char* wish = std::getenv("HYPERLATTICE_SPRINGS");
  return wish != nullptr && std::string_view(wish) == "exact";
}

inline const char* spring_arithmetic() { return asked_for_exact_springs() ? "exact" : "series"; }

}  // namespace hyperlattice
