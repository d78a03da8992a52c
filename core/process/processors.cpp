#include <process/control_group.hpp>
#include <process/processors.hpp>

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <thread>
#include <vector>

namespace hyperlattice {

namespace {

/// Counts the processors of the affinity mask; a machine may have more than a cpu_set_t holds.
int allowed_by_mask() {
  constexpr std::size_t most = 1 << 16;
  for (std::size_t processors = CPU_SETSIZE; processors <= most; processors *= 2) {
    std::vector<cpu_set_t> mask(processors / CPU_SETSIZE);
    const std::size_t bytes = mask.size() * sizeof(cpu_set_t);
    if (sched_getaffinity(0, bytes, mask.data()) == 0) return CPU_COUNT_S(bytes, mask.data());
  }
  return static_cast<int>(std::thread::hardware_concurrency());
}

}  // namespace

int processors(const std::filesystem::path& root) {
  const int allowed = std::max(1, allowed_by_mask());
  const auto granted = ControlGroups(root).processors();
  if (!granted || !(*granted < allowed)) return allowed;
  return std::max(1, static_cast<int>(std::ceil(*granted - 1e-9)));
}

int processors_of_each(int processes) {
  const long all = ::sysconf(_SC_NPROCESSORS_ONLN);
  const auto granted = ControlGroups("/").processors();
  const double shared =
      granted ? std::min(*granted, static_cast<double>(all)) : static_cast<double>(all);
  return std::clamp(static_cast<int>(shared / processes), 1, processors());
}

}  // namespace hyperlattice
