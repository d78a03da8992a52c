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

// The kernels of each law of a material that has several, in the files of the instruction sets.
namespace baseline {
template <class Law>
KernelSet kernels_of_law(const KernelChoice& choice);
}
namespace avx2 {
template <class Law>
KernelSet kernels_of_law(const KernelChoice& choice);
}
namespace avx512 {
template <class Law>
KernelSet kernels_of_law(const KernelChoice& choice);
}

namespace detail {
using MakeKernels = KernelSet(const KernelChoice& choice);
/// Returns `kernels` with the measurements of others.
inline KernelSet measured_by(const KernelSet& others, KernelSet kernels) {
  kernels.measure = others.measure;
  kernels.measure_row = others.measure_row;
  return kernels;
}
inline KernelSet widest_kernels(const KernelChoice& choice, MakeKernels& baseline,
                                MakeKernels& avx2, MakeKernels& avx512) {
  switch (processor_instructions()) {
    case Instructions::avx512:
      return measured_by(avx2(choice), avx512(choice));
    case Instructions::avx2:
      return avx2(choice);
    case Instructions::baseline:
      break;
  }
  return baseline(choice);
}
}  // namespace detail

/// Returns the kernels with the widest instructions that the processor can run, or with narrower
/// ones if the environment has HYPERLATTICE_INSTRUCTIONS=baseline or avx2.
inline KernelSet kernels_for_processor(const KernelChoice& choice) {
#if defined(HYPERLATTICE_X86_KERNELS)
  return detail::widest_kernels(choice, hyperlattice_kernels_baseline, hyperlattice_kernels_avx2,
                                hyperlattice_kernels_avx512);
#else
  return hyperlattice_kernels_baseline(choice);
#endif
}

/// Returns the same for one law of a material that has several (CMake: LAW law.hpp Law OtherLaw).
template <class Law>
KernelSet kernels_for_processor(const KernelChoice& choice) {
#if defined(HYPERLATTICE_X86_KERNELS)
  return detail::widest_kernels(choice, baseline::kernels_of_law<Law>, avx2::kernels_of_law<Law>,
                                avx512::kernels_of_law<Law>);
#else
  return baseline::kernels_of_law<Law>(choice);
#endif
}

}  // namespace hyperlattice
