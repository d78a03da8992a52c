// This plugin registers no component.
#include "law.hpp"

HYPERLATTICE_PLUGIN("1.0") { static_cast<void>(plugin); }
