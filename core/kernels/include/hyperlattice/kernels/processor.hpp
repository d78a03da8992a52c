// The instruction sets of this processor, for libraries that contain code for several.
#pragma once

#include <cstdlib>
#include <string_view>

namespace hyperlattice {

enum class Instructions { baseline, avx2, avx512 };

/// Returns the widest instruction set that the processor can run, or a narrower one if the
/// environment has HYPERLATTICE_INSTRUCTIONS=baseline or avx2.
inline Instructions processor_instructions() {
#if defined(__x86_64__)
  const char* wish = std::getenv("HYPERLATTICE_INSTRUCTIONS");
  const std::string_view most = wish != nullptr ? wish : "avx512";
  __builtin_cpu_init();
  if (most == "avx512" && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
    return Instructions::avx512;
  if (most != "baseline" && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    return Instructions::avx2;
#endif
  return Instructions::baseline;
}

}  // namespace hyperlattice
