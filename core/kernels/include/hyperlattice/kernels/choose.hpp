// Chooses the instruction set of a material's kernels for this processor. Included by the
// material's own source.
#pragma once

#include <hyperlattice/kernel_set.hpp>
#include <hyperlattice/kernels/processor.hpp>

hyperlattice::KernelSet hyperlattice_kernels_baseline(const hyperlattice::KernelChoice& choice);
hyperlattice::KernelSet hyperlattice_kernels_avx2(const hyperlattice::KernelChoice& choice);
hyperlattice::KernelSet hyperlattice_kernels_avx512(const hyperlattice::KernelChoice& choice);

/// Names the law of a material that is one source file: HYPERLATTICE_LAW(MyLaw), outside of any
/// namespace. The program then compiles the kernels of the law from the same file.
#define HYPERLATTICE_LAW(Law) static_assert(sizeof(Law) > 0)

namespace hyperlattice {

/// Returns the kernels with the widest instructions that the processor can run, or with narrower
/// ones if the environment has HYPERLATTICE_INSTRUCTIONS=baseline or avx2.
inline KernelSet kernels_for_processor(const KernelChoice& choice) {
#if defined(HYPERLATTICE_X86_KERNELS)
  switch (processor_instructions()) {
    case Instructions::avx512:
      return hyperlattice_kernels_avx512(choice);
    case Instructions::avx2:
      return hyperlattice_kernels_avx2(choice);
    case Instructions::baseline:
      break;
  }
#endif
  return hyperlattice_kernels_baseline(choice);
}

}  // namespace hyperlattice
