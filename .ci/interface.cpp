// What crosses between program and plugin, for abidiff: the tables of functions hang on pointers
// without a type, so that nothing that the library exports leads to them. See .ci/abi and the list
// in boundary.hpp.
#include <hyperlattice/boundary.hpp>

namespace hyperlattice {

#define HYPERLATTICE_SHOW(Struct, ...) \
  __attribute__((visibility("default"))) void cross(Struct&) {}
HYPERLATTICE_BOUNDARY(HYPERLATTICE_SHOW)

}  // namespace hyperlattice
