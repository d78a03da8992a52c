#include <run/archive.hpp>

#include <hyperlattice/chance.hpp>

#include <algorithm>
#include <cstring>

namespace hyperlattice {

void Archive::bytes(void* data, std::size_t size) {
  if (size == 0) return;
  transfer_(data, size);
  const char* from = static_cast<const char*>(data);
  for (std::size_t n = 0; n < size; n += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, from + n, std::min(sizeof word, size - n));
    sum_ = mixed_bits(sum_ ^ word);
  }
}

}  // namespace hyperlattice
