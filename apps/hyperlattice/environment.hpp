// The environment variables that the program obeys.
#pragma once

namespace hyperlattice {

/// InputError with each variable of the program's own whose value means nothing.
void check_environment();

}  // namespace hyperlattice
