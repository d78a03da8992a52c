// Eight numbers at a time, in the vector extension that gcc and clang share: one notation for every instruction set.
// Included only by kernels, which are compiled once for each; the namespace keeps their functions apart.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#if defined(__AVX__)
#include <immintrin.h>
#endif

#ifndef HYPERLATTICE_INSTRUCTIONS
#define HYPERLATTICE_INSTRUCTIONS baseline
#endif

namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS {

/// Calls body<0>(), ..., body<number - 1>(): a loop that is unrolled from the start, so that small arrays stay in registers.
template <std::size_t number, class Body>
[[gnu::always_inline]] inline void each(const Body& body) {
  [&]<std::size_t... n>(std::index_sequence<n...>) __attribute__((always_inline)) { (body.template operator()<n>(), ...); }
  (std::make_index_sequence<number>());
}

typedef double Pack __attribute__((vector_size(64)));
typedef std::int64_t Mask __attribute__((vector_size(64)));  // all bits of a lane set: true
typedef std::uint16_t Bits __attribute__((vector_size(16)));
typedef double Half __attribute__((vector_size(32)));

typedef double Unaligned __attribute__((vector_size(64), aligned(8)));

inline Pack load(const double* from) { return *reinterpret_cast<const Unaligned*>(from); }
inline void store(double* to, Pack pack) { *reinterpret_cast<Unaligned*>(to) = pack; }
inline Pack fill(double value) { return Pack{} + value; }

inline Bits load_bits(const std::uint16_t* from) {
  Bits bits;
  std::memcpy(&bits, from, sizeof bits);
  return bits;
}
/// Lanes whose bit in the byte is set.
inline Mask lanes_of(std::uint8_t byte) {
  constexpr Mask bit{1, 2, 4, 8, 16, 32, 64, 128};
  return ((Mask{} + byte) & bit) != 0;
}
inline bool same(Bits a, Bits b) { return std::memcmp(&a, &b, sizeof a) == 0; }
/// All that is set in some lane.
inline std::uint16_t joined(Bits bits) {
  std::uint64_t halves[2];
  std::memcpy(halves, &bits, sizeof bits);
  std::uint64_t all = halves[0] | halves[1];
  all |= all >> 32;
  return static_cast<std::uint16_t>(all | all >> 16);
}
/// a b, rounded: where it is added to two sums, a product and two additions share the processor's units better than two fused ones.
inline Pack product(Pack a, Pack b) {
#if defined(__GNUC__) && !defined(__clang__)
  return __builtin_assoc_barrier(a * b);
#else
  return a * b;
#endif
}
/// A choice of lanes.
#if defined(__AVX512F__)
typedef __mmask8 Lanes;
inline Lanes lanes_with(Bits bits, std::uint16_t bit) {  // whose 16 bits have `bit` set
  return _mm_test_epi16_mask(reinterpret_cast<__m128i>(bits), _mm_set1_epi16(static_cast<short>(bit)));
}
inline Pack where(Lanes lanes, Pack pack) { return reinterpret_cast<Pack>(_mm512_maskz_mov_pd(lanes, reinterpret_cast<__m512d>(pack))); }
#else
typedef Mask Lanes;
inline Lanes lanes_with(Bits bits, std::uint16_t bit) { return __builtin_convertvector(bits & bit, Mask) != 0; }
#endif
inline Pack where(Mask mask, Pack pack) { return reinterpret_cast<Pack>(mask & reinterpret_cast<Mask>(pack)); }  // 0 elsewhere
inline Pack select(Mask mask, Pack yes, Pack no) {
  return reinterpret_cast<Pack>((mask & reinterpret_cast<Mask>(yes)) | (~mask & reinterpret_cast<Mask>(no)));
}
inline bool any(Mask mask) {
#if defined(__AVX512F__)
  return _mm512_test_epi64_mask(reinterpret_cast<__m512i>(mask), reinterpret_cast<__m512i>(mask)) != 0;
#elif defined(__AVX__)
  __m256d halves[2];
  std::memcpy(halves, &mask, sizeof mask);
  return _mm256_movemask_pd(_mm256_or_pd(halves[0], halves[1])) != 0;
#else
  std::int64_t joined = 0;
  for (int lane = 0; lane < 8; ++lane) joined |= mask[lane];
  return joined != 0;
#endif
}
/// Gathers whether a lane of any vector is not between its bounds, or not a number; asked once for several vectors.
class Outside {
 public:
#if defined(__AVX512F__)
  void look(Pack x, double low, double high) {
    const __m512d value = reinterpret_cast<__m512d>(x);
    found_ |= _mm512_cmp_pd_mask(value, _mm512_set1_pd(low), _CMP_NGE_UQ) | _mm512_cmp_pd_mask(value, _mm512_set1_pd(high), _CMP_NLE_UQ);
  }
  explicit operator bool() const { return found_ != 0; }

 private:
  unsigned found_ = 0;
#else
  void look(Pack x, double low, double high) { found_ |= ~((x >= low) & (x <= high)); }
  explicit operator bool() const { return any(found_); }

 private:
  Mask found_{};
#endif
};
/// The lanes one further: the last of `before`, then all but the last of `now`.
inline Pack one_further(Pack before, Pack now) { return __builtin_shufflevector(before, now, 7, 8, 9, 10, 11, 12, 13, 14); }
/// The lanes one back: all but the first of `now`, then the first of `next`.
inline Pack one_back(Pack now, Pack next) { return __builtin_shufflevector(now, next, 1, 2, 3, 4, 5, 6, 7, 8); }
/// Sum of the lanes, always in the same order.
inline double sum(Pack p) { return ((p[0] + p[1]) + (p[2] + p[3])) + ((p[4] + p[5]) + (p[6] + p[7])); }

inline Pack root(Pack x) {
#if defined(__AVX512F__)
  return reinterpret_cast<Pack>(_mm512_maskz_sqrt_pd(0xff, reinterpret_cast<__m512d>(x)));
#elif defined(__AVX__)
  __m256d halves[2];
  std::memcpy(halves, &x, sizeof x);
  halves[0] = _mm256_sqrt_pd(halves[0]);
  halves[1] = _mm256_sqrt_pd(halves[1]);
  std::memcpy(&x, halves, sizeof x);
  return x;
#else
  for (int lane = 0; lane < 8; ++lane) x[lane] = __builtin_sqrt(x[lane]);
  return x;
#endif
}
inline Pack absolute(Pack x) { return reinterpret_cast<Pack>(reinterpret_cast<Mask>(x) & INT64_MAX); }
/// |magnitude| with the sign of `sign`; 0 where `sign` is 0.
inline Pack with_sign(Pack magnitude, Pack sign) {
  const Mask bits = (reinterpret_cast<Mask>(magnitude) & INT64_MAX) | (reinterpret_cast<Mask>(sign) & INT64_MIN);
  return where(sign != 0.0, reinterpret_cast<Pack>(bits));
}

}  // namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS
