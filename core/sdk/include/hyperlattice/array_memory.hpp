// Memory for large arrays: aligned to cache lines, in pages of 2 MiB where the system provides
// them. A large page replaces 512 small ones, which the system would clear one by one, and whose
// addresses the processor would look up in sweeps over tens of rows at once.
#pragma once

#include <cstddef>
#include <new>

#if __has_include(<sys/mman.h>)
#include <sys/mman.h>
#endif

namespace hyperlattice {

constexpr std::size_t cache_line = 64, large_page = std::size_t{2} << 20;

/// Allocates uninitialised memory, in bytes. The last part, less than a large page, uses small
/// pages, so that no more is taken than requested. Throws std::bad_alloc.
inline void* allocate_array(std::size_t bytes) {
  const std::size_t whole = bytes / large_page * large_page;
  void* memory = ::operator new[](bytes, std::align_val_t{whole > 0 ? large_page : cache_line});
#ifdef MADV_HUGEPAGE
  if (whole > 0) madvise(memory, whole, MADV_HUGEPAGE);  // only a hint: small pages work too
#endif
  return memory;
}

/// Frees memory of that many bytes from allocate_array.
inline void free_array(void* memory, std::size_t bytes) noexcept {
  ::operator delete[](memory, std::align_val_t{bytes >= large_page ? large_page : cache_line});
}

/// Allocator for standard containers.
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
