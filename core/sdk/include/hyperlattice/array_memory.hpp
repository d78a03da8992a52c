// Memory of large arrays: aligned to cache lines, and in pages of 2 MiB where the system gives
// them. One of these stands for 512 small pages, which the system would have to clear one by one,
// and the processor to look up, in sweeps that have tens of rows in hand at once.
#pragma once

#include <cstddef>
#include <new>

#if __has_include(<sys/mman.h>)
#include <sys/mman.h>
#endif

namespace hyperlattice {

constexpr std::size_t cache_line = 64, large_page = std::size_t{2} << 20;

/// Uninitialised memory, in bytes. Its last part, less than a large page, is in small ones: nothing
/// is claimed that is not asked for. Throws std::bad_alloc.
inline void* allocate_array(std::size_t bytes) {
  const std::size_t whole = bytes / large_page * large_page;
  void* memory = ::operator new[](bytes, std::align_val_t{whole > 0 ? large_page : cache_line});
#ifdef MADV_HUGEPAGE
  if (whole > 0) madvise(memory, whole, MADV_HUGEPAGE);  // a wish: small pages serve too
#endif
  return memory;
}

/// Of that many bytes, from allocate_array.
inline void free_array(void* memory, std::size_t bytes) noexcept {
  ::operator delete[](memory, std::align_val_t{bytes >= large_page ? large_page : cache_line});
}

/// The same for standard containers.
template <class T>
struct ArrayMemory {
  using value_type = T;
  ArrayMemory() = default;
  template <class Other>
  ArrayMemory(const ArrayMemory<Other>&) noexcept {
  }  // NOLINT(google-explicit-constructor): as the standard asks of allocators

  T* allocate(std::size_t size) { return static_cast<T*>(allocate_array(size * sizeof(T))); }
  void deallocate(T* memory, std::size_t size) noexcept { free_array(memory, size * sizeof(T)); }
  bool operator==(const ArrayMemory&) const = default;
};

}  // namespace hyperlattice
