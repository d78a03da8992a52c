// An array of numbers as a file of VTK holds it. Sizes are unsigned 64-bit numbers:
//   without a codec: number of bytes; the numbers
//   with a codec:    number of blocks, bytes of a block, bytes of the last block if it is shorter
//                    (else 0), packed bytes of each block; then the packed blocks
#pragma once

#include <vtk/codec.hpp>

#include <hyperlattice/files.hpp>
#include <hyperlattice/output.hpp>

#include <algorithm>
#include <concepts>
#include <memory>
#include <numeric>
#include <span>

namespace hyperlattice::vtk {

template <class Number>
std::string_view bytes_of(std::span<const Number> numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes()};
}

class EncodedArray {
 public:
  /// Encodes values as numbers of the type `Number`. The tasks of the snapshot share the blocks;
  /// the bytes do not depend on the threads.
  template <class Number, class Value>
  void encode(const Snapshot& snapshot, Codec codec, std::span<const Value> values) {
    constexpr std::size_t block_numbers = block_bytes / sizeof(Number);
    header_.clear();
    blocks_.resize((values.size() + block_numbers - 1) / block_numbers);
    snapshot.for_each(blocks_.size(), [&](std::uint64_t n) {
      const auto part = values.subspan(n * block_numbers,
                                       std::min(block_numbers, values.size() - n * block_numbers));
      Block& block = blocks_[n];
      if constexpr (std::same_as<Number, Value>) {
        block.size = pack(codec, bytes_of(part), block.bytes);
      } else {
        const auto numbers = std::make_unique_for_overwrite<Number[]>(part.size());
        std::transform(part.begin(), part.end(), numbers.get(),
                       [](Value value) { return static_cast<Number>(value); });
        const std::span<const Number> converted(numbers.get(), part.size());
        block.size = pack(codec, bytes_of(converted), block.bytes);
      }
    });
    make_header(codec, values.size() * sizeof(Number));
  }

  /// Returns whether nothing was encoded yet.
  bool empty() const { return header_.empty(); }
  /// Returns the number of bytes in a file.
  std::size_t size() const {
    return std::accumulate(blocks_.begin(), blocks_.end(), header_.size() * sizeof(std::uint64_t),
                           [](std::size_t sum, const Block& block) { return sum + block.size; });
  }
  void write(AtomicFile& file) const {
    file.write(bytes_of<std::uint64_t>(header_));
    for (const Block& block : blocks_) file.write({block.bytes.data(), block.size});
  }

 private:
  /// Larger than zlib's window, and small enough to stay in a processor's cache.
  static constexpr std::size_t block_bytes = 1 << 18;

  struct Block {
    std::vector<char> bytes;  ///< memory, kept for the next frame
    std::size_t size = 0;
  };

  void make_header(Codec codec, std::size_t bytes) {
    if (codec == Codec::none) {
      header_ = {bytes};
      return;
    }
    header_ = {blocks_.size(), block_bytes, bytes % block_bytes};
    for (const Block& block : blocks_) header_.push_back(block.size);
  }

  std::vector<std::uint64_t> header_;
  std::vector<Block> blocks_;
};

}  // namespace hyperlattice::vtk
