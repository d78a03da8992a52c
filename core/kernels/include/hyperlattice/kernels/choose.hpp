// Which of a material's compiled kernels this processor gets. Included by the material's own
// source.
#pragma once

#include <hyperlattice/kernels/processor.hpp>
#include <hyperlattice/material.hpp>

hyperlattice::KernelSet hyperlattice_kernels_baseline(const hyperlattice::KernelChoice& choice);
hyperlattice::KernelSet hyperlattice_kernels_avx2(const hyperlattice::KernelChoice& choice);
hyperlattice::KernelSet hyperlattice_kernels_avx512(const hyperlattice::KernelChoice& choice);

namespace hyperlattice {

/// The fastest kernels that the processor can run; HYPERLATTICE_INSTRUCTIONS=baseline or avx2 in
/// the environment asks for less.
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
