// Packs of numbers: one notation for both precisions and every instruction set. A pack has 64
// bytes, eight doubles or sixteen floats, in as many vectors as the processor needs, written in the
// vector extension that gcc and clang share. (gcc splits one vector wider than the processor's
// through memory.) Only kernels include this file; they are compiled once for each instruction set,
// and the namespace keeps their functions apart.
#pragma once

#include <hyperlattice/kernel_request.hpp>

#include <cstddef>
#include <cstdint>
#include <utility>

#ifndef HYPERLATTICE_INSTRUCTIONS
#define HYPERLATTICE_INSTRUCTIONS baseline
#endif
#define HYPERLATTICE_INLINE [[gnu::always_inline]] inline

namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS {

/// Calls body<0>(), ..., body<number - 1>(): a loop that is always unrolled, so that small arrays
/// stay in registers.
template <std::size_t number, class Body>
HYPERLATTICE_INLINE void each(const Body& body) {
  [&]<std::size_t... n>(std::index_sequence<n...>) __attribute__((always_inline)) {
    (body.template operator()<n>(), ...);
  }
  (std::make_index_sequence<number>());
}

#if defined(__AVX512F__)
inline constexpr int vector_bytes = 64;
#elif defined(__AVX__)
inline constexpr int vector_bytes = 32;
#else
inline constexpr int vector_bytes = 16;
#endif
inline constexpr std::size_t vectors = 64 / vector_bytes;  ///< vectors in a pack

/// The vector types of a precision. An integer is as wide as a number. A Choice selects the lanes
/// whose bits are all set. Bits holds the alive bits of the sites of a pack.
template <class Real>
struct VectorsOf;
template <>
struct VectorsOf<double> {
  typedef std::int64_t Integer;
  typedef double Vector __attribute__((vector_size(vector_bytes)));
  typedef double VectorAnywhere __attribute__((vector_size(vector_bytes), aligned(8)));
  typedef float NarrowAnywhere __attribute__((vector_size(vector_bytes / 2), aligned(4)));
  typedef std::int64_t Choice __attribute__((vector_size(vector_bytes)));
  typedef std::uint16_t Bits __attribute__((vector_size(16)));
  typedef std::uint16_t BitsOfVector __attribute__((vector_size(vector_bytes / 4)));
};
template <>
struct VectorsOf<float> {
  typedef std::int32_t Integer;
  typedef float Vector __attribute__((vector_size(vector_bytes)));
  typedef float VectorAnywhere __attribute__((vector_size(vector_bytes), aligned(4)));
  typedef std::int32_t Choice __attribute__((vector_size(vector_bytes)));
  typedef std::uint16_t Bits __attribute__((vector_size(32)));
  typedef std::uint16_t BitsOfVector __attribute__((vector_size(vector_bytes / 2)));
};
template <class Real>
using BitsOf = typename VectorsOf<Real>::Bits;

template <class Real>
struct MaskOf {
  typename VectorsOf<Real>::Choice part[vectors];
};

template <class Real>
struct PackOf {
  using Vector = typename VectorsOf<Real>::Vector;
  using Choice = typename VectorsOf<Real>::Choice;
  using Mask = MaskOf<Real>;

  Vector part[vectors];

  PackOf() = default;
  HYPERLATTICE_INLINE PackOf(double value) {  // the same value in each lane
    each<vectors>([&]<std::size_t p>() __attribute__((always_inline)) {
      part[p] = Vector{} + static_cast<Real>(value);
    });
  }

  template <class Operation>
  HYPERLATTICE_INLINE static PackOf of(const Operation& operation) {
    PackOf pack;
    each<vectors>([&]<std::size_t p>()
                      __attribute__((always_inline)) { pack.part[p] = operation(p); });
    return pack;
  }
  HYPERLATTICE_INLINE friend PackOf operator+(const PackOf& a, const PackOf& b) {
    return of([&](std::size_t p) __attribute__((always_inline)) { return a.part[p] + b.part[p]; });
  }
  HYPERLATTICE_INLINE friend PackOf operator-(const PackOf& a, const PackOf& b) {
    return of([&](std::size_t p) __attribute__((always_inline)) { return a.part[p] - b.part[p]; });
  }
  HYPERLATTICE_INLINE friend PackOf operator*(const PackOf& a, const PackOf& b) {
    return of([&](std::size_t p) __attribute__((always_inline)) { return a.part[p] * b.part[p]; });
  }
  HYPERLATTICE_INLINE friend PackOf operator/(const PackOf& a, const PackOf& b) {
    return of([&](std::size_t p) __attribute__((always_inline)) { return a.part[p] / b.part[p]; });
  }
  HYPERLATTICE_INLINE friend PackOf operator-(const PackOf& a) {
    return of([&](std::size_t p) __attribute__((always_inline)) { return -a.part[p]; });
  }
  HYPERLATTICE_INLINE friend Mask operator>(const PackOf& a, const PackOf& b) {
    Mask mask;
    each<vectors>([&]<std::size_t p>()
                      __attribute__((always_inline)) { mask.part[p] = a.part[p] > b.part[p]; });
    return mask;
  }
  HYPERLATTICE_INLINE PackOf& operator+=(const PackOf& other) { return *this = *this + other; }
  HYPERLATTICE_INLINE PackOf& operator-=(const PackOf& other) { return *this = *this - other; }
  HYPERLATTICE_INLINE PackOf& operator*=(const PackOf& other) { return *this = *this * other; }
};

}  // namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS
