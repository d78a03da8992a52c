// How kernels compute springs: by series where these are exact to rounding, or by roots and
// divisions everywhere. The environment asks for the latter by HYPERLATTICE_SPRINGS=exact; it is
// the oracle of tests.
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
