// The largest memory that this process has had.
#pragma once

#include <cstdint>

namespace hyperlattice {

/// Returns the largest resident memory of this process so far, bytes.
std::int64_t peak_memory_bytes();

}  // namespace hyperlattice
