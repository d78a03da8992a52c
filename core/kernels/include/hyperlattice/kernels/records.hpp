// Records of the particles of a list: position at rest and displacement at the start of the step,
// side by side in memory because springs need both. The records of a pack of particles are loaded
// in pieces of 16 bytes, which are transposed in registers.
#pragma once

#include <hyperlattice/kernels/simd.hpp>

namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS {

/// Element n: number n of each record of a pack of particles, one particle per lane.
template <class Real>
using Records = std::array<PackOf<Real>, record_numbers>;

/// Returns elements index(0), index(1), ... of a followed by b, `size` of them.
template <std::size_t size, class Vector, class Index>
HYPERLATTICE_INLINE auto picked(const Vector& a, const Vector& b, Index) {
  return [&]<std::size_t... n>(std::index_sequence<n...>) __attribute__((always_inline)) {
    return __builtin_shufflevector(a, b, Index{}(n)...);
  }
  (std::make_index_sequence<size>());
}

/// Returns a vector of pieces of 16 bytes from records that are `apart` records away from each
/// other.
template <class Real>
HYPERLATTICE_INLINE typename VectorsOf<Real>::Vector pieces(const Real* const* records,
                                                            std::size_t offset,
                                                            [[maybe_unused]] std::size_t apart) {
#if defined(__AVX__)
  const auto piece = [&](std::size_t n) __attribute__((always_inline)) {
    return _mm_loadu_ps(reinterpret_cast<const float*>(records[n * apart] + offset));
  };
  const auto two = [&](std::size_t n) __attribute__((always_inline)) {
    return _mm256_insertf128_ps(_mm256_castps128_ps256(piece(n)), piece(n + 1), 1);
  };
#if defined(__AVX512F__)
  return reinterpret_cast<typename VectorsOf<Real>::Vector>(
      _mm512_insertf32x8(_mm512_castps256_ps512(two(0)), two(2), 1));
#else
  return reinterpret_cast<typename VectorsOf<Real>::Vector>(two(0));
#endif
#else
  return *reinterpret_cast<const typename VectorsOf<Real>::VectorAnywhere*>(records[0] + offset);
#endif
}

/// Returns a0 b0 of each 16 bytes of two vectors, or, with half = 1, the numbers of the second
/// half; a number has `as` elements.
template <std::size_t as, std::size_t half, class Vector>
HYPERLATTICE_INLINE auto interleaved(const Vector& a, const Vector& b) {
  constexpr std::size_t size = sizeof(Vector) / sizeof a[0];
  return picked<size>(a, b, [](std::size_t n) {
    constexpr std::size_t in_piece = 16 / (sizeof(Vector) / size);
    const std::size_t place = n % in_piece, number = place / as;
    return n - place + half * in_piece / 2 + number / 2 * as + place % as + number % 2 * size;
  });
}

template <class Real>
HYPERLATTICE_INLINE Records<Real> load_records(const Real* const (&records)[lanes_of<Real>]) {
  constexpr std::size_t in_piece = 16 / sizeof(Real), in_vector = vector_bytes / sizeof(Real);
  Records<Real> numbers;
  each<vectors>([&]<std::size_t p>() __attribute__((always_inline)) {
    each<record_numbers / in_piece>([&]<std::size_t q>() __attribute__((always_inline)) {
      const auto of = [&](std::size_t n) __attribute__((always_inline)) {
        return pieces(records + p * in_vector + n, q * in_piece, in_piece);
      };
      auto* const to = &numbers[q * in_piece];
      if constexpr (in_piece == 2) {
        const auto a = of(0), b = of(1);
        to[0].part[p] = interleaved<1, 0>(a, b);
        to[1].part[p] = interleaved<1, 1>(a, b);
      } else {
        const auto a = of(0), b = of(1), c = of(2), d = of(3);
        const auto ab = interleaved<1, 0>(a, b), cd = interleaved<1, 0>(c, d),
                   ab_further = interleaved<1, 1>(a, b), cd_further = interleaved<1, 1>(c, d);
        to[0].part[p] = interleaved<2, 0>(ab, cd);
        to[1].part[p] = interleaved<2, 1>(ab, cd);
        to[2].part[p] = interleaved<2, 0>(ab_further, cd_further);
        to[3].part[p] = interleaved<2, 1>(ab_further, cd_further);
      }
    });
  });
  return numbers;
}

/// Loads records that are stored in another precision.
template <class Real, class Stored, std::size_t lanes>
HYPERLATTICE_INLINE Records<Real> load_records_as(const Stored* const (&records)[lanes]) {
  if constexpr (std::is_same_v<Real, Stored>) {
    return load_records(records);
  } else {
    Real number[record_numbers][lanes];
    for (std::size_t lane = 0; lane < lanes; ++lane)
      for (std::size_t n = 0; n < record_numbers; ++n)
        number[n][lane] = static_cast<Real>(records[lane][n]);
    Records<Real> numbers;
    for (std::size_t n = 0; n < record_numbers; ++n) numbers[n] = load(number[n]);
    return numbers;
  }
}

}  // namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS
