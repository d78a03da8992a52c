// The environment names the fault that a misbehaving plugin must commit.
#pragma once

#include <cstdlib>
#include <string_view>

inline bool asked_for(std::string_view fault) {
  const char* wish = std::getenv("HYPERLATTICE_TEST_FAULT");
  return wish != nullptr && fault == wish;
}
