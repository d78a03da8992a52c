// MPI in this process, alone: hypre asks for it.
#pragma once

namespace hyperlattice::statics {

/// Starts MPI and hypre when first called, ends them with the process.
void start_mpi();

}  // namespace hyperlattice::statics
