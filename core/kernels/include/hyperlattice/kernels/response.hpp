// The response of a spring: force over length, from the growth q of its squared length.
//
// For a law that is linear in the elongation, with p = q / L0^2,
//   k (L - L0) / L = k (1 - 1 / sqrt(1 + p)) = k p (1/2 - 3/8 p + 5/16 p^2 - ...).
// For |p| up to a few hundredths the series is as exact as root and division, and much faster.
// Springs that grow more, and other laws, use the root.
#pragma once

#include <hyperlattice/kernel_request.hpp>
#include <hyperlattice/kernels/simd.hpp>
#include <hyperlattice/law.hpp>

#include <array>
#include <limits>

namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS {

/// Response of a spring: force divided by length, N/m, and stored energy, J.
template <class Pack>
struct ResponseOf {
  Pack force_over_length, energy;
};
using Response = ResponseOf<Pack>;

/// Returns the squares of the present lengths of springs, given those of their rest lengths and
/// their growth. Where the ends of a spring meet, a part of its rest length remains, so that its
/// force over its length stays finite; the direction of its force is then not known.
template <class Real>
HYPERLATTICE_INLINE PackOf<Real> present_square(const PackOf<Real>& rest_square,
                                                const PackOf<Real>& growth) {
  constexpr Real least = std::is_same_v<Real, double> ? Real(1e-24) : Real(1e-10);
  return larger(rest_square + growth, least * rest_square);
}

/// Returns force over length and, if Energy, energy of springs whose squared length grew by q from
/// rest_length^2. Length: one number for all lanes, or a pack. `constants`: those of the law.
template <class Law, bool Energy, class Pack, class Length>
inline ResponseOf<Pack> respond(Pack stiffness, Length rest_length, Pack q,
                                const double* constants) {
  const Pack length = root(present_square(Pack(rest_length * rest_length), q));
  const Pack inverse = 1.0 / (length * (length + rest_length));
  const Pack elongation = q * length * inverse;
  const auto spring = [&](Pack along) {
    return SpringOf<Pack>{stiffness, Pack(rest_length), along};
  };
  ResponseOf<Pack> response;
  if constexpr (is_linear<Law>)
    response.force_over_length = force_of<Law>(spring(q * inverse), constants);
  else
    response.force_over_length =
        force_of<Law>(spring(elongation), constants) * ((length + rest_length) * inverse);
  if constexpr (Energy) response.energy = energy_of<Law>(spring(elongation), constants);
  return response;
}

/// Coefficients of (1 - 1 / sqrt(1 + p)) / p in powers of p, exact to rounding for |p| <= range.
template <std::size_t terms>
struct Series {
  double range;
  std::array<double, terms> coefficients{};

  /// Starts from Taylor's series and spreads its last terms over the first ones with Chebyshev
  /// polynomials,
  ///   2 (range/2)^n T_n(p/range) = p^n - n (range/2)^2 p^(n-2) + ...,
  /// which are small in the whole range.
  explicit constexpr Series(double r) : range(r) {
    std::array<double, 20> taylor{0.5};
    for (std::size_t n = 1; n < taylor.size(); ++n)
      taylor[n] = -taylor[n - 1] * static_cast<double>(2 * n + 1) / static_cast<double>(2 * n + 2);
    for (std::size_t n = taylor.size() - 1; n >= terms; --n) {
      double term = taylor[n];
      for (std::size_t i = 1; 2 * i <= n; ++i) {
        const std::size_t power = n - 2 * i;
        term *= -range * range / 4 * static_cast<double>((power + 2) * (power + 1)) /
                static_cast<double>(i * (n - i));
        taylor[power] -= term;
      }
    }
    for (std::size_t n = 0; n < terms; ++n) coefficients[n] = taylor[n];
  }
};

/// The terms of the sums: `few` for small strains; `many` for larger ones, as many as cost less
/// than a root.
template <class Real>
struct Terms;
template <>
struct Terms<double> {
  static constexpr Series<7> few{1.0 / 128};
  static constexpr Series<11> many{1.0 / 16};
};
template <>
struct Terms<float> {
  static constexpr Series<4> few{1.0 / 32};
  static constexpr Series<8> many{1.0 / 4};
};

/// Returns the force over length of springs of a linear law with stiffness k and relative growth
/// p = q / L0^2, all in the range of the short series.
template <class Law, class Real>
HYPERLATTICE_INLINE PackOf<Real> pull_near_rest(const PackOf<Real>& stiffness,
                                                const PackOf<Real>& rest_length,
                                                const PackOf<Real>& p, const double* constants) {
  constexpr auto& c = Terms<Real>::few.coefficients;
  PackOf<Real> sum = c.back();
  each<c.size() - 1>([&]<std::size_t n>() __attribute__((always_inline)) {
    sum = sum * p + PackOf<Real>(c[c.size() - 2 - n]);
  });
  return force_of<Law>(SpringOf<PackOf<Real>>{stiffness, rest_length, sum * p}, constants);
}

/// Springs of one class between two materials, base or cross, with constants prepared for the loop.
///
/// The short series is in powers of q; its coefficients include the rest length, and the force over
/// length is q times its sum. The long series is in powers of p.
template <class Law, class Real>
class SpringKind {
  using Pack = PackOf<Real>;
  using Few = decltype(Terms<Real>::few);
  using Many = decltype(Terms<Real>::many);
  static constexpr std::size_t few_terms = Terms<Real>::few.coefficients.size(),
                               many_terms = Terms<Real>::many.coefficients.size();

 public:
  SpringKind() = default;
  /// `constants`: those of the law, which must outlive the kind; `alarm`: elongation, m; infinity
  /// if there is no alarm.
  [[gnu::noinline]] SpringKind(double stiffness, double rest_length, const double* constants,
                               double alarm)
      : stiffness_(stiffness), rest_length_(rest_length), constants_(constants) {
    if (alarm < infinity) alarm_ = static_cast<Real>(squared_growth<Real>(rest_length, alarm));
    if constexpr (is_linear<Law>) {
      const double square = rest_length * rest_length;
      const bool fits = set(few_, Terms<Real>::few.coefficients, square);
      set(many_, Terms<Real>::many.coefficients, 1);
      if (fits) highest_ = static_cast<Real>(Terms<Real>::few.range * square);
    }
    lowest_ = -highest_;
    if (alarm_ < highest_) highest_ = alarm_;
  }

  /// Computes force over length of several springs at a time. Returns a bit for each pack with a
  /// spring above its alarm.
  template <std::size_t number>
  HYPERLATTICE_INLINE static std::uint32_t pull(const SpringKind* const (&kinds)[number],
                                                const Pack (&q)[number], Pack (&pull)[number]) {
    Outside<Real> outside;
    each<number>([&]<std::size_t s>() __attribute__((always_inline)) {
      outside.look(q[s], kinds[s]->lowest_, kinds[s]->highest_);
    });
    if (outside) [[unlikely]] {
      std::uint32_t rung = 0;
      for (std::size_t s = 0; s < number; ++s) {
        pull[s] = kinds[s]->far(q[s]);
        if (any(q[s] > Pack(kinds[s]->alarm_))) rung |= 1u << s;
      }
      return rung;
    }
    each<number>([&]<std::size_t s>()
                     __attribute__((always_inline)) { pull[s] = kinds[s]->few_[few_terms - 1]; });
    each<few_terms - 1>([&]<std::size_t n>() __attribute__((
        always_inline)) {  // interleaved, so that no sum waits for itself
      each<number>([&]<std::size_t s>() __attribute__((always_inline)) {
        pull[s] = pull[s] * q[s] + Pack(kinds[s]->few_[few_terms - 2 - n]);
      });
    });
    each<number>([&]<std::size_t s>() __attribute__((always_inline)) { pull[s] *= q[s]; });
    return 0;
  }

 private:
  /// Sets the coefficient of each power n to the law's force for series[n] / square^(n + 1).
  /// Returns false if this precision cannot hold them.
  template <std::size_t terms>
  bool set(Real (&to)[terms], const std::array<double, terms>& series, double square) const {
    constexpr double most = std::numeric_limits<Real>::max() / 1e3,
                     least = std::numeric_limits<Real>::min() * 1e3;
    double power = 1 / square;
    bool fits = true;
    for (std::size_t n = 0; n < terms; ++n, power /= square) {
      const double coefficient = force_of<Law>(
                       SpringOf<double>{stiffness_, rest_length_, series[n] * power}, constants_),
                   size = coefficient < 0 ? -coefficient : coefficient;
      fits = fits && (size == 0 || (size > least && size < most));
      to[n] = fits ? static_cast<Real>(coefficient) : Real{};
    }
    return fits;
  }

  /// Returns force over length of springs that are not all near their rest length.
  [[gnu::noinline]] Pack far(Pack q) const {
    if constexpr (is_linear<Law>) {
      const double square = rest_length_ * rest_length_;
      const Pack p = q * Pack(1 / square);
      Outside<Real> outside;
      constexpr Real range = static_cast<Real>(Terms<Real>::many.range);
      outside.look(p, -range, range);
      if (!outside) {
        Pack pull = many_[many_terms - 1];
        each<many_terms - 1>([&]<std::size_t n>() __attribute__((always_inline)) {
          pull = pull * p + Pack(many_[many_terms - 2 - n]);
        });
        return pull * p;
      }
    }
    return respond<Law, false>(Pack(stiffness_), rest_length_, q, constants_).force_over_length;
  }

  Real few_[few_terms] = {}, many_[many_terms] = {};
  /// Range of q in which the short series holds and no alarm is reached.
  Real lowest_ = 1, highest_ = -1;
  /// Alarm as growth of the squared length, m2.
  Real alarm_ = std::numeric_limits<Real>::infinity();
  double stiffness_ = 0, rest_length_ = 0;
  const double* constants_ = nullptr;
};

}  // namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS
