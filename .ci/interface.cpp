// Shows abidiff all types that cross between program and plugin. Pointers to the tables of
// functions have no type, so that no exported symbol leads to these types. See .ci/abi, and the
// list in boundary.hpp.
#include <hyperlattice/boundary.hpp>

namespace hyperlattice {

#define HYPERLATTICE_SHOW(Struct, ...) \
  __attribute__((visibility("default"))) void cross(Struct&) {}
HYPERLATTICE_BOUNDARY(HYPERLATTICE_SHOW)

}  // namespace hyperlattice
