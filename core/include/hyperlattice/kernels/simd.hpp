// Eight numbers at a time: one notation for every instruction set. A pack is made of as many vectors as the processor needs for eight numbers, in
// the vector extension that gcc and clang share. (A single vector wider than the processor's is taken apart by gcc, but through memory.)
// Included only by kernels, which are compiled once for each instruction set; the namespace keeps their functions apart.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

#ifndef HYPERLATTICE_INSTRUCTIONS
#define HYPERLATTICE_INSTRUCTIONS baseline
#endif
#define HYPERLATTICE_INLINE [[gnu::always_inline]] inline

namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS {

/// Calls body<0>(), ..., body<number - 1>(): a loop that is unrolled from the start, so that small arrays stay in registers.
template <std::size_t number, class Body>
HYPERLATTICE_INLINE void each(const Body& body) {
  [&]<std::size_t... n>(std::index_sequence<n...>) __attribute__((always_inline)) { (body.template operator()<n>(), ...); }
  (std::make_index_sequence<number>());
}

#if defined(__AVX512F__)
inline constexpr int vector_bytes = 64;
#elif defined(__AVX__)
inline constexpr int vector_bytes = 32;
#else
inline constexpr int vector_bytes = 16;
#endif
inline constexpr std::size_t vectors = 64 / vector_bytes;  ///< of a pack

typedef double Vector __attribute__((vector_size(vector_bytes)));
typedef double VectorAnywhere __attribute__((vector_size(vector_bytes), aligned(8)));
typedef std::int64_t Choice __attribute__((vector_size(vector_bytes)));             // all bits of a lane set: chosen
typedef std::uint16_t Bits __attribute__((vector_size(16)));                        // of eight sites
typedef std::uint16_t BitsOfVector __attribute__((vector_size(vector_bytes / 4)));  // of those in a vector

struct Mask {
  Choice part[vectors];
};

struct Pack {
  Vector part[vectors];

  Pack() = default;
  HYPERLATTICE_INLINE Pack(double value) {  // in each lane
    each<vectors>([&]<std::size_t p>() __attribute__((always_inline)) { part[p] = Vector{} + value; });
  }

  template <class Operation>
  HYPERLATTICE_INLINE static Pack of(const Operation& operation) {
    Pack pack;
    each<vectors>([&]<std::size_t p>() __attribute__((always_inline)) { pack.part[p] = operation(p); });
    return pack;
  }
  HYPERLATTICE_INLINE friend Pack operator+(const Pack& a, const Pack& b) {
    return of([&](std::size_t p) __attribute__((always_inline)) { return a.part[p] + b.part[p]; });
  }
  HYPERLATTICE_INLINE friend Pack operator-(const Pack& a, const Pack& b) {
    return of([&](std::size_t p) __attribute__((always_inline)) { return a.part[p] - b.part[p]; });
  }
  HYPERLATTICE_INLINE friend Pack operator*(const Pack& a, const Pack& b) {
    return of([&](std::size_t p) __attribute__((always_inline)) { return a.part[p] * b.part[p]; });
  }
  HYPERLATTICE_INLINE friend Pack operator/(const Pack& a, const Pack& b) {
    return of([&](std::size_t p) __attribute__((always_inline)) { return a.part[p] / b.part[p]; });
  }
  HYPERLATTICE_INLINE friend Pack operator-(const Pack& a) {
    return of([&](std::size_t p) __attribute__((always_inline)) { return -a.part[p]; });
  }
  HYPERLATTICE_INLINE friend Mask operator>(const Pack& a, const Pack& b) {
    Mask mask;
    each<vectors>([&]<std::size_t p>() __attribute__((always_inline)) { mask.part[p] = a.part[p] > b.part[p]; });
    return mask;
  }
  HYPERLATTICE_INLINE Pack& operator+=(const Pack& other) { return *this = *this + other; }
  HYPERLATTICE_INLINE Pack& operator-=(const Pack& other) { return *this = *this - other; }
  HYPERLATTICE_INLINE Pack& operator*=(const Pack& other) { return *this = *this * other; }
};

HYPERLATTICE_INLINE Pack fill(double value) { return value; }
HYPERLATTICE_INLINE Pack load(const double* from) {
  return Pack::of([&](std::size_t p) __attribute__((always_inline)) { return reinterpret_cast<const VectorAnywhere*>(from)[p]; });
}
HYPERLATTICE_INLINE void store(double* to, const Pack& pack) {
  each<vectors>([&]<std::size_t p>() __attribute__((always_inline)) { reinterpret_cast<VectorAnywhere*>(to)[p] = pack.part[p]; });
}
/// Four packs from eight records of four numbers: number c of the record of lane n goes to lane n of packs[c].
HYPERLATTICE_INLINE void load_records(const double* const (&records)[8], Pack (&packs)[4]) {
#if defined(__AVX512F__)
  typedef double Four __attribute__((vector_size(32), aligned(8)));
  const auto two = [&](std::size_t a, std::size_t b) __attribute__((always_inline)) {
    return __builtin_shufflevector(*reinterpret_cast<const Four*>(records[a]), *reinterpret_cast<const Four*>(records[b]), 0, 1, 2, 3, 4, 5, 6, 7);
  };
  const Vector r02 = two(0, 2), r13 = two(1, 3), r46 = two(4, 6), r57 = two(5, 7);
  const Vector even_low = __builtin_shufflevector(r02, r13, 0, 8, 2, 10, 4, 12, 6, 14),
               odd_low = __builtin_shufflevector(r02, r13, 1, 9, 3, 11, 5, 13, 7, 15);
  const Vector even_high = __builtin_shufflevector(r46, r57, 0, 8, 2, 10, 4, 12, 6, 14),
               odd_high = __builtin_shufflevector(r46, r57, 1, 9, 3, 11, 5, 13, 7, 15);
  packs[0].part[0] = __builtin_shufflevector(even_low, even_high, 0, 1, 4, 5, 8, 9, 12, 13);
  packs[1].part[0] = __builtin_shufflevector(odd_low, odd_high, 0, 1, 4, 5, 8, 9, 12, 13);
  packs[2].part[0] = __builtin_shufflevector(even_low, even_high, 2, 3, 6, 7, 10, 11, 14, 15);
  packs[3].part[0] = __builtin_shufflevector(odd_low, odd_high, 2, 3, 6, 7, 10, 11, 14, 15);
#elif defined(__AVX__)
  each<2>([&]<std::size_t p>() __attribute__((always_inline)) {
    const auto record = [&](std::size_t n) __attribute__((always_inline)) { return *reinterpret_cast<const VectorAnywhere*>(records[4 * p + n]); };
    const Vector a = record(0), b = record(1), c = record(2), d = record(3);
    const Vector even_low = __builtin_shufflevector(a, b, 0, 4, 2, 6), odd_low = __builtin_shufflevector(a, b, 1, 5, 3, 7);
    const Vector even_high = __builtin_shufflevector(c, d, 0, 4, 2, 6), odd_high = __builtin_shufflevector(c, d, 1, 5, 3, 7);
    packs[0].part[p] = __builtin_shufflevector(even_low, even_high, 0, 1, 4, 5);
    packs[1].part[p] = __builtin_shufflevector(odd_low, odd_high, 0, 1, 4, 5);
    packs[2].part[p] = __builtin_shufflevector(even_low, even_high, 2, 3, 6, 7);
    packs[3].part[p] = __builtin_shufflevector(odd_low, odd_high, 2, 3, 6, 7);
  });
#else
  each<4>([&]<std::size_t p>() __attribute__((always_inline)) {
    each<2>([&]<std::size_t half>() __attribute__((always_inline)) {
      const auto record = [&](std::size_t n) __attribute__((always_inline)) {
        return *reinterpret_cast<const VectorAnywhere*>(records[2 * p + n] + 2 * half);
      };
      const Vector a = record(0), b = record(1);
      packs[2 * half].part[p] = __builtin_shufflevector(a, b, 0, 2);
      packs[2 * half + 1].part[p] = __builtin_shufflevector(a, b, 1, 3);
    });
  });
#endif
}
/// Sum of the lanes, always in the same order.
inline double sum(const Pack& pack) {
  double p[8];
  store(p, pack);
  return ((p[0] + p[1]) + (p[2] + p[3])) + ((p[4] + p[5]) + (p[6] + p[7]));
}

// Sites' bits.
inline Bits load_bits(const std::uint16_t* from) {
  Bits bits;
  std::memcpy(&bits, from, sizeof bits);
  return bits;
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

/// Some of the lanes.
#if defined(__AVX512F__)
typedef __mmask8 Lanes;
HYPERLATTICE_INLINE Lanes lanes_with(Bits bits, std::uint16_t bit) {  // whose bits have `bit` set
  return _mm_test_epi16_mask(reinterpret_cast<__m128i>(bits), _mm_set1_epi16(static_cast<short>(bit)));
}
HYPERLATTICE_INLINE Lanes lanes_of(std::uint8_t byte) { return byte; }  // whose bit is set
HYPERLATTICE_INLINE Lanes not_zero(const Pack& pack) { return _mm512_cmp_pd_mask(pack.part[0], _mm512_setzero_pd(), _CMP_NEQ_UQ); }
HYPERLATTICE_INLINE Pack where(Lanes lanes, Pack pack) {
  pack.part[0] = _mm512_maskz_mov_pd(lanes, pack.part[0]);
  return pack;
}
#else
typedef Mask Lanes;
HYPERLATTICE_INLINE Lanes lanes_with(Bits bits, std::uint16_t bit) {
  BitsOfVector of_vector[vectors];
  std::memcpy(of_vector, &bits, sizeof bits);
  Lanes lanes;
  each<vectors>([&]<std::size_t p>() __attribute__((always_inline)) {
#if defined(__AVX2__)
    std::int64_t four;
    std::memcpy(&four, &of_vector[p], sizeof four);
    const __m256i wide = _mm256_cvtepu16_epi64(_mm_cvtsi64_si128(four));
    lanes.part[p] = reinterpret_cast<Choice>(wide) << __builtin_clzll(bit) >> 63;
#else
    lanes.part[p] = __builtin_convertvector(of_vector[p], Choice) << __builtin_clzll(bit) >> 63;
#endif
  });
  return lanes;
}
inline Lanes lanes_of(std::uint8_t byte) {
  std::int64_t all[8];
  for (unsigned lane = 0; lane < 8; ++lane) all[lane] = -(byte >> lane & 1);
  Lanes lanes;
  std::memcpy(&lanes, all, sizeof all);
  return lanes;
}
HYPERLATTICE_INLINE Lanes not_zero(const Pack& pack) {
  Lanes lanes;
  each<vectors>([&]<std::size_t p>() __attribute__((always_inline)) { lanes.part[p] = pack.part[p] != 0.0; });
  return lanes;
}
HYPERLATTICE_INLINE Pack where(const Mask& mask, const Pack& pack) {  // 0 elsewhere
  return Pack::of([&](std::size_t p)
                      __attribute__((always_inline)) { return reinterpret_cast<Vector>(mask.part[p] & reinterpret_cast<Choice>(pack.part[p])); });
}
#endif

inline bool any(const Mask& mask) {
  std::int64_t lanes[8], joined = 0;
  std::memcpy(lanes, &mask, sizeof lanes);
  for (const std::int64_t lane : lanes) joined |= lane;
  return joined != 0;
}

/// Gathers whether a lane of any pack is not between its bounds, or not a number; asked once for several packs.
class Outside {
 public:
#if defined(__AVX512F__)
  HYPERLATTICE_INLINE void look(const Pack& x, double low, double high) {
    found_ |= _mm512_cmp_pd_mask(x.part[0], _mm512_set1_pd(low), _CMP_NGE_UQ) | _mm512_cmp_pd_mask(x.part[0], _mm512_set1_pd(high), _CMP_NLE_UQ);
  }
  HYPERLATTICE_INLINE void look_above(const Pack& x, const Pack& high) { found_ |= _mm512_cmp_pd_mask(x.part[0], high.part[0], _CMP_NLE_UQ); }
  explicit operator bool() const { return found_ != 0; }

 private:
  unsigned found_ = 0;
#else
  HYPERLATTICE_INLINE void look(const Pack& x, double low, double high) {
    each<vectors>([&]<std::size_t p>() __attribute__((always_inline)) { found_ |= ~((x.part[p] >= low) & (x.part[p] <= high)); });
  }
  HYPERLATTICE_INLINE void look_above(const Pack& x, const Pack& high) {
    each<vectors>([&]<std::size_t p>() __attribute__((always_inline)) { found_ |= ~(x.part[p] <= high.part[p]); });
  }
#if defined(__AVX__)
  explicit operator bool() const { return _mm256_movemask_pd(reinterpret_cast<__m256d>(found_)) != 0; }
#else
  explicit operator bool() const { return (found_[0] | found_[1]) != 0; }
#endif

 private:
  Choice found_{};
#endif
};

/// The lanes one further: the last of `before`, then all but the last of `now`.
HYPERLATTICE_INLINE Pack one_further(const Pack& before, const Pack& now) {
  return Pack::of([&](std::size_t p) __attribute__((always_inline)) {
    const Vector left = p == 0 ? before.part[vectors - 1] : now.part[p - 1], right = now.part[p];
#if defined(__AVX512F__)
    return __builtin_shufflevector(left, right, 7, 8, 9, 10, 11, 12, 13, 14);
#elif defined(__AVX__)
    return __builtin_shufflevector(left, right, 3, 4, 5, 6);
#else
    return __builtin_shufflevector(left, right, 1, 2);
#endif
  });
}
/// The lanes one back: all but the first of `now`, then the first of `next`.
inline Pack one_back(const Pack& now, const Pack& next) {
  double both[16];
  store(both, now);
  store(both + 8, next);
  return load(both + 1);
}

/// a b, rounded: where it is added to two sums, a product and two additions share the processor's units better than two fused ones.
HYPERLATTICE_INLINE Pack product(const Pack& a, const Pack& b) {
#if defined(__GNUC__) && !defined(__clang__)
  return Pack::of([&](std::size_t p) __attribute__((always_inline)) { return __builtin_assoc_barrier(a.part[p] * b.part[p]); });
#else
  return a * b;
#endif
}
HYPERLATTICE_INLINE Pack root(const Pack& x) {
  return Pack::of([&](std::size_t p) __attribute__((always_inline)) {
#if defined(__AVX512F__)
    return _mm512_maskz_sqrt_pd(0xff, x.part[p]);
#elif defined(__AVX__)
    return _mm256_sqrt_pd(x.part[p]);
#else
    Vector result = x.part[p];
    for (std::size_t lane = 0; lane < 8 / vectors; ++lane) result[lane] = __builtin_sqrt(result[lane]);
    return result;
#endif
  });
}
HYPERLATTICE_INLINE Pack absolute(const Pack& x) {
  return Pack::of([&](std::size_t p)
                      __attribute__((always_inline)) { return reinterpret_cast<Vector>(reinterpret_cast<Choice>(x.part[p]) & INT64_MAX); });
}
/// |magnitude| with the sign of `sign`; 0 where `sign` is 0.
HYPERLATTICE_INLINE Pack with_sign(const Pack& magnitude, const Pack& sign) {
  return Pack::of([&](std::size_t p) __attribute__((always_inline)) {
    const Choice bits = (reinterpret_cast<Choice>(magnitude.part[p]) & INT64_MAX) | (reinterpret_cast<Choice>(sign.part[p]) & INT64_MIN);
    return reinterpret_cast<Vector>((sign.part[p] != 0.0) & bits);
  });
}

}  // namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS
