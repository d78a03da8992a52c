#include <process/peak_memory.hpp>

#include <sys/resource.h>

namespace hyperlattice {

std::int64_t peak_memory_bytes() {
  constexpr std::int64_t unit = 1024;  // bytes, of Linux
  struct rusage usage {};
  getrusage(RUSAGE_SELF, &usage);
  return std::int64_t{usage.ru_maxrss} * unit;
}

}  // namespace hyperlattice
