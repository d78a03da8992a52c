#include "mpi_session.hpp"

#include <HYPRE_utilities.h>
#include <mpi.h>

#include <cstdlib>
#include <stdexcept>

namespace hyperlattice::statics {

namespace {

bool ours = false;  // MPI was not there before

void end_mpi() {
  int over = 0;
  MPI_Finalized(&over);
  if (over != 0) return;
  HYPRE_Finalize();
  if (ours) MPI_Finalize();
}

}  // namespace

void start_mpi() {
  static const bool started = [] {
    // Open MPI, alone: no daemon, no look at networks or displays, no folder of its own. What the environment says goes first.
    for (const auto& [name, value] :
         {std::pair("OMPI_MCA_ess_singleton_isolated", "1"), std::pair("OMPI_MCA_pml", "ob1"), std::pair("OMPI_MCA_btl", "self"),
          std::pair("OMPI_MCA_if", "linux_ipv6"), std::pair("OMPI_MCA_orte_create_session_dirs", "0"), std::pair("HWLOC_COMPONENTS", "-gl,-opencl")})
      setenv(name, value, 0);
    int there = 0;
    MPI_Initialized(&there);
    ours = there == 0;
    if (ours && MPI_Init(nullptr, nullptr) != MPI_SUCCESS) throw std::runtime_error("MPI, which hypre needs, does not start");
    if (ours) MPI_Comm_set_errhandler(MPI_COMM_SELF, MPI_ERRORS_RETURN);
    HYPRE_Init();
    std::atexit(end_mpi);
    return true;
  }();
  static_cast<void>(started);
}

}  // namespace hyperlattice::statics
