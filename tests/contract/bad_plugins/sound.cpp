// Nothing is wrong with it; how it is compiled, or where it lies, may be. Its static constructor
// leaves a trace, so that a test sees whether any code of it ran.
#include "law.hpp"

#include <cstdlib>

static const int ran = setenv("HYPERLATTICE_CONSTRUCTED", TYPE, 1);

HYPERLATTICE_PLUGIN("1.0") {
  static_cast<void>(ran);
  plugin.add<Law>();
}
