// Eight numbers at a time, in the vector extension that gcc and clang share: one notation for every instruction set.
// Included only by kernels, which are compiled once for each; the namespace keeps their functions apart.
#pragma once

#include <cstdint>
#include <cstring>

#if defined(__AVX__)
#include <immintrin.h>
#endif

#ifndef HYPERLATTICE_INSTRUCTIONS
#define HYPERLATTICE_INSTRUCTIONS baseline
#endif

namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS {

typedef double Pack __attribute__((vector_size(64)));
typedef std::int64_t Mask __attribute__((vector_size(64)));  // all bits of a lane set: true
typedef std::uint16_t Bits __attribute__((vector_size(16)));
typedef double Half __attribute__((vector_size(32)));

inline Pack load(const double* from) {
  Pack pack;
  std::memcpy(&pack, from, sizeof pack);
  return pack;
}
inline void store(double* to, Pack pack) { std::memcpy(to, &pack, sizeof pack); }
inline Pack fill(double value) { return Pack{} + value; }

/// Lanes whose 16 bits have `bit` set.
inline Mask lanes_with(const std::uint16_t* from, std::uint16_t bit) {
  Bits bits;
  std::memcpy(&bits, from, sizeof bits);
  return __builtin_convertvector(bits & bit, Mask) != 0;
}
/// Lanes whose bit in the byte is set.
inline Mask lanes_of(std::uint8_t byte) {
  constexpr Mask bit{1, 2, 4, 8, 16, 32, 64, 128};
  return ((Mask{} + byte) & bit) != 0;
}
inline Pack where(Mask mask, Pack pack) { return reinterpret_cast<Pack>(mask & reinterpret_cast<Mask>(pack)); }  // 0 elsewhere
inline Pack select(Mask mask, Pack yes, Pack no) {
  return reinterpret_cast<Pack>((mask & reinterpret_cast<Mask>(yes)) | (~mask & reinterpret_cast<Mask>(no)));
}
inline bool any(Mask mask) {
  std::int64_t joined = 0;
  for (int lane = 0; lane < 8; ++lane) joined |= mask[lane];
  return joined != 0;
}
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
