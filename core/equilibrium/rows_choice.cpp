#include <equilibrium/rows.hpp>

#include <hyperlattice/kernels/processor.hpp>

namespace hyperlattice::equilibrium {

namespace baseline {
extern const RowKernels kernels;
}
namespace avx2 {
extern const RowKernels kernels;
}
namespace avx512 {
extern const RowKernels kernels;
}

const RowKernels& row_kernels() {
#if defined(HYPERLATTICE_X86_KERNELS)
  switch (processor_instructions()) {
    case Instructions::avx512:
      return avx512::kernels;
    case Instructions::avx2:
      return avx2::kernels;
    case Instructions::baseline:
      break;
  }
#endif
  return baseline::kernels;
}

}  // namespace hyperlattice::equilibrium
