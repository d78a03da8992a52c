#include <process/small_pages.hpp>

#include <sys/mman.h>
#include <unistd.h>

#include <memory>

namespace hyperlattice {

void use_small_pages(std::span<std::byte> memory) {
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  void* first = memory.data();
  std::size_t size = memory.size();
  if (std::align(page, page, first, size) == nullptr) return;  // less than a page
  ::madvise(first, size / page * page, MADV_NOHUGEPAGE);
}

}  // namespace hyperlattice
