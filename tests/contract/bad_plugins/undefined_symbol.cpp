// This plugin calls a function that no library has.
#include "law.hpp"

void function_that_nobody_wrote(int);

HYPERLATTICE_PLUGIN("1.0") {
  function_that_nobody_wrote(1);
  plugin.add<Law>();
}
