// What kernels do with packs: loads and stores, lanes that are chosen by the alive bits of sites,
// shifts, signs.
#pragma once

#include <hyperlattice/kernels/pack.hpp>

#include <cstring>
#include <type_traits>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS {

using Pack = PackOf<double>;

template <class Real = double>
HYPERLATTICE_INLINE PackOf<Real> fill(double value) {
  return value;
}
template <class Real>
HYPERLATTICE_INLINE PackOf<Real> load(const Real* from) {
  using Anywhere = typename VectorsOf<Real>::VectorAnywhere;
  return PackOf<Real>::of([&](std::size_t p) __attribute__((always_inline)) {
    return reinterpret_cast<const Anywhere*>(from)[p];
  });
}
/// Loads numbers that are stored in another precision.
template <class Real, class Stored>
HYPERLATTICE_INLINE PackOf<Real> load_as(const Stored* from) {
  using Vectors = VectorsOf<Real>;
  if constexpr (std::is_same_v<Real, Stored>) {
    return load(from);
  } else if constexpr (std::is_same_v<Real, double>) {
    return Pack::of([&](std::size_t p) __attribute__((always_inline)) {
      return __builtin_convertvector(
          reinterpret_cast<const typename Vectors::NarrowAnywhere*>(from)[p],
          typename Vectors::Vector);
    });
  } else {
    Real values[lanes_of<Real>];
    for (int lane = 0; lane < lanes_of<Real>; ++lane) values[lane] = static_cast<Real>(from[lane]);
    return load(values);
  }
}
/// Loads sixteen floats from eight doubles at `low` and eight at `high`.
HYPERLATTICE_INLINE PackOf<float> load_halves(const double* low, const double* high) {
  typedef double Doubles __attribute__((vector_size(vector_bytes), aligned(8)));
  typedef float Half __attribute__((vector_size(vector_bytes / 2)));
  constexpr std::size_t in_half = vector_bytes / sizeof(double), halves = 2 * vectors;
  const auto half = [&](std::size_t n) __attribute__((always_inline)) {
    const double* from = n < halves / 2 ? low + n * in_half : high + (n - halves / 2) * in_half;
    return __builtin_convertvector(*reinterpret_cast<const Doubles*>(from), Half);
  };
  return PackOf<float>::of([&](std::size_t p) __attribute__((always_inline)) {
    const Half left = half(2 * p), right = half(2 * p + 1);
    return [&]<std::size_t... n>(std::index_sequence<n...>) __attribute__((always_inline)) {
      return __builtin_shufflevector(left, right, n...);
    }
    (std::make_index_sequence<vector_bytes / sizeof(float)>());
  });
}
template <class Real>
HYPERLATTICE_INLINE void store(Real* to, const PackOf<Real>& pack) {
  each<vectors>([&]<std::size_t p>() __attribute__((always_inline)) {
    reinterpret_cast<typename VectorsOf<Real>::VectorAnywhere*>(to)[p] = pack.part[p];
  });
}
/// Returns the sum of the lanes, always in the same order.
template <class Real>
inline double sum(const PackOf<Real>& pack) {
  constexpr int number = lanes_of<Real>;
  Real lane[number];
  store(lane, pack);
  double partial[number];
  for (int n = 0; n < number; ++n) partial[n] = static_cast<double>(lane[n]);
  for (int left = number / 2; left > 0; left /= 2)
    for (int n = 0; n < left; ++n) partial[n] = partial[2 * n] + partial[2 * n + 1];
  return partial[0];
}

// Alive bits of sites.
template <class Real = double>
inline BitsOf<Real> load_bits(const std::uint16_t* from) {
  BitsOf<Real> bits;
  std::memcpy(&bits, from, sizeof bits);
  return bits;
}
template <class Bits>
inline bool same(Bits a, Bits b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

/// A subset of the lanes.
#if defined(__AVX512F__)
template <class Real>
using LanesOf = std::conditional_t<std::is_same_v<Real, double>, __mmask8, __mmask16>;
template <class Real = double>
HYPERLATTICE_INLINE LanesOf<Real> lanes_with(BitsOf<Real> bits,
                                             std::uint16_t bit) {  // lanes whose bits include `bit`
  if constexpr (std::is_same_v<Real, double>)
    return _mm_test_epi16_mask(reinterpret_cast<__m128i>(bits),
                               _mm_set1_epi16(static_cast<short>(bit)));
  else
    return _mm256_test_epi16_mask(reinterpret_cast<__m256i>(bits),
                                  _mm256_set1_epi16(static_cast<short>(bit)));
}
HYPERLATTICE_INLINE LanesOf<double> lanes_of_byte(std::uint8_t byte) {
  return byte;
}  // lanes whose bit is set
HYPERLATTICE_INLINE LanesOf<double> not_zero(const Pack& pack) {
  return _mm512_cmp_pd_mask(pack.part[0], _mm512_setzero_pd(), _CMP_NEQ_UQ);
}
HYPERLATTICE_INLINE LanesOf<float> not_zero(const PackOf<float>& pack) {
  return _mm512_cmp_ps_mask(pack.part[0], _mm512_setzero_ps(), _CMP_NEQ_UQ);
}
HYPERLATTICE_INLINE Pack where(LanesOf<double> lanes, Pack pack) {  // 0 in other lanes
  pack.part[0] = _mm512_maskz_mov_pd(lanes, pack.part[0]);
  return pack;
}
HYPERLATTICE_INLINE PackOf<float> where(LanesOf<float> lanes, PackOf<float> pack) {
  pack.part[0] = _mm512_maskz_mov_ps(lanes, pack.part[0]);
  return pack;
}
#else
template <class Real>
using LanesOf = MaskOf<Real>;
template <class Real = double>
HYPERLATTICE_INLINE LanesOf<Real> lanes_with(BitsOf<Real> bits, std::uint16_t bit) {
  using Vectors = VectorsOf<Real>;
  constexpr int top = 8 * sizeof(Real) - 1;
  typename Vectors::BitsOfVector of_vector[vectors];
  std::memcpy(of_vector, &bits, sizeof bits);
  const int shift = top - (31 - __builtin_clz(bit));
  LanesOf<Real> lanes;
  each<vectors>([&]<std::size_t p>() __attribute__((always_inline)) {
#if defined(__AVX2__)
    if constexpr (std::is_same_v<Real, double>) {
      std::int64_t four;
      std::memcpy(&four, &of_vector[p], sizeof four);
      lanes.part[p] =
          reinterpret_cast<typename Vectors::Choice>(_mm256_cvtepu16_epi64(_mm_cvtsi64_si128(four)))
              << shift >>
          top;
    } else {
      lanes.part[p] = reinterpret_cast<typename Vectors::Choice>(
                          _mm256_cvtepu16_epi32(reinterpret_cast<__m128i>(of_vector[p])))
                          << shift >>
                      top;
    }
#else
    lanes.part[p] = __builtin_convertvector(of_vector[p], typename Vectors::Choice) << shift >> top;
#endif
  });
  return lanes;
}
inline LanesOf<double> lanes_of_byte(std::uint8_t byte) {
  std::int64_t all[8];
  for (unsigned lane = 0; lane < 8; ++lane) all[lane] = -(byte >> lane & 1);
  LanesOf<double> lanes;
  std::memcpy(&lanes, all, sizeof all);
  return lanes;
}
template <class Real>
HYPERLATTICE_INLINE LanesOf<Real> not_zero(const PackOf<Real>& pack) {
  LanesOf<Real> lanes;
  each<vectors>([&]<std::size_t p>()
                    __attribute__((always_inline)) { lanes.part[p] = pack.part[p] != Real{0}; });
  return lanes;
}
template <class Real>
HYPERLATTICE_INLINE PackOf<Real> where(const MaskOf<Real>& mask,
                                       const PackOf<Real>& pack) {  // 0 in other lanes
  using Vectors = VectorsOf<Real>;
  return PackOf<Real>::of([&](std::size_t p) __attribute__((always_inline)) {
    return reinterpret_cast<typename Vectors::Vector>(
        mask.part[p] & reinterpret_cast<typename Vectors::Choice>(pack.part[p]));
  });
}
#endif

template <class Real>
inline bool any(const MaskOf<Real>& mask) {
  std::int64_t words[8], joined = 0;
  std::memcpy(words, &mask, sizeof words);
  for (const std::int64_t word : words) joined |= word;
  return joined != 0;
}

/// Records whether a lane of any pack is outside its bounds or not a number; tested once for
/// several packs.
template <class Real>
class Outside {
 public:
#if defined(__AVX512F__)
  HYPERLATTICE_INLINE void look(const PackOf<Real>& x, Real low, Real high) {
    if constexpr (std::is_same_v<Real, double>)
      found_ |= _mm512_cmp_pd_mask(x.part[0], _mm512_set1_pd(low), _CMP_NGE_UQ) |
                _mm512_cmp_pd_mask(x.part[0], _mm512_set1_pd(high), _CMP_NLE_UQ);
    else
      found_ |= _mm512_cmp_ps_mask(x.part[0], _mm512_set1_ps(low), _CMP_NGE_UQ) |
                _mm512_cmp_ps_mask(x.part[0], _mm512_set1_ps(high), _CMP_NLE_UQ);
  }
  HYPERLATTICE_INLINE void look_above(const PackOf<Real>& x, const PackOf<Real>& high) {
    if constexpr (std::is_same_v<Real, double>)
      found_ |= _mm512_cmp_pd_mask(x.part[0], high.part[0], _CMP_NLE_UQ);
    else
      found_ |= _mm512_cmp_ps_mask(x.part[0], high.part[0], _CMP_NLE_UQ);
  }
  explicit operator bool() const { return found_ != 0; }

 private:
  unsigned found_ = 0;
#else
  HYPERLATTICE_INLINE void look(const PackOf<Real>& x, Real low, Real high) {
    each<vectors>([&]<std::size_t p>() __attribute__((always_inline)) {
      found_ |= ~((x.part[p] >= low) & (x.part[p] <= high));
    });
  }
  HYPERLATTICE_INLINE void look_above(const PackOf<Real>& x, const PackOf<Real>& high) {
    each<vectors>([&]<std::size_t p>()
                      __attribute__((always_inline)) { found_ |= ~(x.part[p] <= high.part[p]); });
  }
#if defined(__AVX__)
  explicit operator bool() const {
    return _mm256_movemask_ps(reinterpret_cast<__m256>(found_)) != 0;
  }
#else
  explicit operator bool() const {
    std::int64_t words[2];
    std::memcpy(words, &found_, sizeof words);
    return (words[0] | words[1]) != 0;
  }
#endif

 private:
  typename VectorsOf<Real>::Choice found_{};
#endif
};

/// Returns the lanes shifted up by one: the last of `before`, then all but the last of `now`.
template <class Real>
HYPERLATTICE_INLINE PackOf<Real> one_further(const PackOf<Real>& before, const PackOf<Real>& now) {
  using Vector = typename PackOf<Real>::Vector;
  return PackOf<Real>::of([&](std::size_t p) __attribute__((always_inline)) {
    const Vector left = p == 0 ? before.part[vectors - 1] : now.part[p - 1], right = now.part[p];
    return [&]<std::size_t... n>(std::index_sequence<n...>) __attribute__((always_inline)) {
      return __builtin_shufflevector(left, right, (sizeof...(n) - 1 + n)...);
    }
    (std::make_index_sequence<vector_bytes / sizeof(Real)>());
  });
}
/// Returns the lanes shifted down by one: all but the first of `now`, then the first of `next`.
template <class Real>
HYPERLATTICE_INLINE PackOf<Real> one_back(const PackOf<Real>& now, const PackOf<Real>& next) {
  using Vector = typename PackOf<Real>::Vector;
  return PackOf<Real>::of([&](std::size_t p) __attribute__((always_inline)) {
    const Vector left = now.part[p], right = p + 1 == vectors ? next.part[0] : now.part[p + 1];
    return [&]<std::size_t... n>(std::index_sequence<n...>) __attribute__((always_inline)) {
      return __builtin_shufflevector(left, right, (n + 1)...);
    }
    (std::make_index_sequence<vector_bytes / sizeof(Real)>());
  });
}

/// Returns the rounded product a b. If it is added to two sums, a product and two additions use the
/// processor's units better than two fused multiply-adds.
template <class Real>
HYPERLATTICE_INLINE PackOf<Real> product(const PackOf<Real>& a, const PackOf<Real>& b) {
#if defined(__GNUC__) && !defined(__clang__)
  return PackOf<Real>::of([&](std::size_t p) __attribute__((always_inline)) {
#if defined(__AVX512F__)
    if constexpr (std::is_same_v<Real,
                                 float>) {  // gcc 12 splits sixteen floats for its own barrier
      typename PackOf<Real>::Vector rounded = a.part[p] * b.part[p];
      __asm__("" : "+v"(rounded));
      return rounded;
    }
#endif
    return __builtin_assoc_barrier(a.part[p] * b.part[p]);
  });
#else
  return a * b;
#endif
}
template <class Real>
HYPERLATTICE_INLINE PackOf<Real> larger(const PackOf<Real>& a, const PackOf<Real>& b) {
  return PackOf<Real>::of([&](std::size_t p) __attribute__((always_inline)) {
    return a.part[p] > b.part[p] ? a.part[p] : b.part[p];
  });
}
template <class Real>
HYPERLATTICE_INLINE PackOf<Real> root(const PackOf<Real>& x) {
  return PackOf<Real>::of([&](std::size_t p) __attribute__((always_inline)) {
    constexpr bool wide = std::is_same_v<Real, double>;
#if defined(__AVX512F__)
    if constexpr (wide)
      return _mm512_maskz_sqrt_pd(0xff, x.part[p]);
    else
      return _mm512_maskz_sqrt_ps(0xffff, x.part[p]);
#elif defined(__AVX__)
    if constexpr (wide)
      return _mm256_sqrt_pd(x.part[p]);
    else
      return _mm256_sqrt_ps(x.part[p]);
#else
    typename PackOf<Real>::Vector result = x.part[p];
    for (std::size_t lane = 0; lane < vector_bytes / sizeof(Real); ++lane) {
      if constexpr (wide)
        result[lane] = __builtin_sqrt(result[lane]);
      else
        result[lane] = __builtin_sqrtf(result[lane]);
    }
    return result;
#endif
  });
}
/// Returns |magnitude| with the sign of `sign`; 0 where `sign` is 0.
template <class Real>
HYPERLATTICE_INLINE PackOf<Real> with_sign(const PackOf<Real>& magnitude,
                                           const PackOf<Real>& sign) {
  using Choice = typename PackOf<Real>::Choice;
  using Integer = typename VectorsOf<Real>::Integer;
  constexpr Integer lowest = std::is_same_v<Real, double> ? static_cast<Integer>(INT64_MIN)
                                                          : static_cast<Integer>(INT32_MIN);
  return PackOf<Real>::of([&](std::size_t p) __attribute__((always_inline)) {
    const Choice bits = (reinterpret_cast<Choice>(magnitude.part[p]) & ~lowest) |
                        (reinterpret_cast<Choice>(sign.part[p]) & lowest);
    return reinterpret_cast<typename PackOf<Real>::Vector>((sign.part[p] != Real{0}) & bits);
  });
}

}  // namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS
