// What crosses between program and plugin, in one place for abidiff: the tables of functions hang on pointers without a type, so that nothing that
// the library exports leads to them. See .ci/abi.
#include <hyperlattice/component.hpp>
#include <hyperlattice/failure.hpp>
#include <hyperlattice/kernels/request.hpp>
#include <hyperlattice/lattice.hpp>
#include <hyperlattice/load.hpp>
#include <hyperlattice/material.hpp>
#include <hyperlattice/output.hpp>
#include <hyperlattice/solver.hpp>

namespace hyperlattice {

struct Interface {
  ComponentInfo component;
  LatticeFunctions lattice;
  MaterialFunctions material;
  FailureFunctions failure;
  LoadFunctions load;
  SolverFunctions solver;
  WriterFunctions writer;
  ProbeFunctions probe;
  KernelRequest kernel;
};

__attribute__((visibility("default"))) void cross(Interface&) {}

}  // namespace hyperlattice
