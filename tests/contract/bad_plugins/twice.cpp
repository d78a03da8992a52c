// This plugin registers the same type twice.
#include "law.hpp"

HYPERLATTICE_PLUGIN("1.0") {
  plugin.add<Law>();
  plugin.add<Law>();
}
