// The ways in which a file of VTK packs its arrays.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace hyperlattice::vtk {

enum class Codec : std::uint32_t { zlib, lz4, none };
inline constexpr std::string_view codecs[] = {"zlib", "lz4", "none"};  ///< in the order of Codec

/// Returns the class of VTK that unpacks; "" for none.
std::string_view compressor_of(Codec codec);

/// Packs at most 1 GiB into `out`, which grows as needed. Returns the number of bytes of the
/// result. Throws std::runtime_error if the codec fails.
std::size_t pack(Codec codec, std::string_view bytes, std::vector<char>& out);

/// Unpacks what pack() wrote. Returns false if it is not whole, or has another size than `out`.
bool unpack(Codec codec, std::string_view packed, std::span<char> out);

}  // namespace hyperlattice::vtk
