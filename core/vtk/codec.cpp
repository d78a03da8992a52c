#include <vtk/codec.hpp>

#include <lz4.h>
#include <zlib.h>

#include <algorithm>
#include <stdexcept>

namespace hyperlattice::vtk {

namespace {

std::size_t pack_zlib(std::string_view bytes, std::vector<char>& out) {
  uLongf size = compressBound(bytes.size());
  if (out.size() < size) out.resize(size);
  if (compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), Z_BEST_SPEED) != Z_OK)
    throw std::runtime_error("zlib cannot compress a block");
  return size;
}

std::size_t pack_lz4(std::string_view bytes, std::vector<char>& out) {
  const int length = static_cast<int>(bytes.size()), bound = LZ4_compressBound(length);
  if (out.size() < static_cast<std::size_t>(bound)) out.resize(static_cast<std::size_t>(bound));
  const int size = LZ4_compress_default(bytes.data(), out.data(), length, bound);
  if (size <= 0) throw std::runtime_error("LZ4 cannot compress a block");
  return static_cast<std::size_t>(size);
}

}  // namespace

std::string_view compressor_of(Codec codec) {
  switch (codec) {
    case Codec::zlib:
      return "vtkZLibDataCompressor";
    case Codec::lz4:
      return "vtkLZ4DataCompressor";
    default:
      return "";
  }
}

std::size_t pack(Codec codec, std::string_view bytes, std::vector<char>& out) {
  switch (codec) {
    case Codec::zlib:
      return pack_zlib(bytes, out);
    case Codec::lz4:
      return pack_lz4(bytes, out);
    default:
      if (out.size() < bytes.size()) out.resize(bytes.size());
      std::copy(bytes.begin(), bytes.end(), out.begin());
      return bytes.size();
  }
}

bool unpack(Codec codec, std::string_view packed, std::span<char> out) {
  switch (codec) {
    case Codec::zlib: {
      uLongf size = out.size();
      return uncompress(reinterpret_cast<Bytef*>(out.data()), &size,
                        reinterpret_cast<const Bytef*>(packed.data()), packed.size()) == Z_OK &&
             size == out.size();
    }
    case Codec::lz4: {
      constexpr std::size_t most = LZ4_MAX_INPUT_SIZE;
      if (packed.size() > most || out.size() > most) return false;
      const int size = static_cast<int>(out.size());
      return LZ4_decompress_safe(packed.data(), out.data(), static_cast<int>(packed.size()),
                                 size) == size;
    }
    default:
      if (packed.size() != out.size()) return false;
      std::copy(packed.begin(), packed.end(), out.begin());
      return true;
  }
}

}  // namespace hyperlattice::vtk
