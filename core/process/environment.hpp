// The environment variables that the program reads.
#pragma once

namespace hyperlattice {

/// Throws InputError with each variable of the program whose value is not allowed. Unsets variables
/// with an empty value.
void check_environment();

}  // namespace hyperlattice
