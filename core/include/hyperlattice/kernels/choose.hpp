// Which of a material's compiled kernels this processor gets. Included by the material's own source.
#pragma once

#include <hyperlattice/material.hpp>

#include <cstdlib>
#include <string_view>

hyperlattice::KernelSet hyperlattice_kernels_baseline(const hyperlattice::KernelChoice& choice);
hyperlattice::KernelSet hyperlattice_kernels_avx2(const hyperlattice::KernelChoice& choice);
hyperlattice::KernelSet hyperlattice_kernels_avx512(const hyperlattice::KernelChoice& choice);

namespace hyperlattice {

/// The fastest kernels that the processor can run; HYPERLATTICE_INSTRUCTIONS=baseline or avx2 in the environment asks for less.
inline KernelSet kernels_for_processor(const KernelChoice& choice) {
#if defined(HYPERLATTICE_X86_KERNELS)
  const char* wish = std::getenv("HYPERLATTICE_INSTRUCTIONS");
  const std::string_view most = wish != nullptr ? wish : "avx512";
  __builtin_cpu_init();
  if (most == "avx512" && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512vl"))
    return hyperlattice_kernels_avx512(choice);
  if (most != "baseline" && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return hyperlattice_kernels_avx2(choice);
#endif
  return hyperlattice_kernels_baseline(choice);
}

}  // namespace hyperlattice
