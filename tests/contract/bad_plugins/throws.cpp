// This plugin registers a sound component and then throws. The host must not accept the component.
#include "law.hpp"

#include <stdexcept>

HYPERLATTICE_PLUGIN("1.0") {
  plugin.add<Law>();
  throw std::runtime_error("the licence has run out");
}
