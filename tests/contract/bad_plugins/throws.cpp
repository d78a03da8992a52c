// Throws after it has registered a sound component, which must not count then.
#include "law.hpp"

#include <stdexcept>

HYPERLATTICE_PLUGIN("1.0") {
  plugin.add<Law>();
  throw std::runtime_error("the licence has run out");
}
