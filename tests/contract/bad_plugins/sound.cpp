// This source has no fault; the fault lies in its compilation or in its place. The static
// constructor leaves a trace, so that a test sees whether any code of the library ran.
#include "law.hpp"

#include <cstdlib>

static const int ran = setenv("HYPERLATTICE_CONSTRUCTED", TYPE, 1);

HYPERLATTICE_PLUGIN("1.0") {
  static_cast<void>(ran);
  plugin.add<Law>();
}
