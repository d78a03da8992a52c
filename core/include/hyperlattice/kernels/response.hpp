// How a spring answers: the force along it over its length, from the growth q of its squared length.
//
// A law that is linear in the elongation gives with p = q / L0^2
//   k (L - L0) / L = k (1 - 1 / sqrt(1 + p)) = k p (1/2 - 3/8 p + 5/16 p^2 - ...),
// and for |p| up to a few hundredths the series is as exact as root and division, and much faster. Springs that grow more, and other laws, take
// the root.
#pragma once

#include <hyperlattice/kernels/request.hpp>
#include <hyperlattice/kernels/simd.hpp>

#include <array>
#include <cstdlib>
#include <string_view>

namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS {

/// A law may say `static constexpr bool linear = true`: its force is proportional to the elongation, which saves arithmetic.
template <class Law>
constexpr bool is_linear = requires {
  requires Law::linear;
};

/// A spring after its law was asked: force along it divided by its length, and what it stores.
struct Response {
  Pack force_over_length, energy;
};

/// Force and, if asked, energy of springs whose squared length grew by q from rest_length^2.
template <class Law, bool Energy, class Length>  // one length for all, or one a lane
inline Response respond(Pack stiffness, Length rest_length, Pack q) {
  const Pack length = root(rest_length * rest_length + q);
  const Pack inverse = 1.0 / (length * (length + rest_length));
  Response response;
  if constexpr (is_linear<Law>) {
    response.force_over_length = Law::force(stiffness, q * inverse);
    if constexpr (Energy) response.energy = Law::energy(stiffness, q * length * inverse);
  } else {
    const Pack elongation = q * length * inverse;
    response.force_over_length = Law::force(stiffness, elongation) * ((length + rest_length) * inverse);
    if constexpr (Energy) response.energy = Law::energy(stiffness, elongation);
  }
  return response;
}

/// (1 - 1 / sqrt(1 + p)) / p in powers of p, exact to rounding for |p| <= range.
template <std::size_t terms>
struct Series {
  double range;
  std::array<double, terms> coefficients{};

  /// Taylor's series whose last terms are spread over the first by Chebyshev's polynomials,
  ///   2 (range/2)^n T_n(p/range) = p^n - n (range/2)^2 p^(n-2) + ...,
  /// which are small all over the range.
  explicit constexpr Series(double r) : range(r) {
    std::array<double, 20> taylor{0.5};
    for (std::size_t n = 1; n < taylor.size(); ++n) taylor[n] = -taylor[n - 1] * static_cast<double>(2 * n + 1) / static_cast<double>(2 * n + 2);
    for (std::size_t n = taylor.size() - 1; n >= terms; --n) {
      double term = taylor[n];
      for (std::size_t i = 1; 2 * i <= n; ++i) {
        const std::size_t power = n - 2 * i;
        term *= -range * range / 4 * static_cast<double>((power + 2) * (power + 1)) / static_cast<double>(i * (n - i));
        taylor[power] -= term;
      }
    }
    for (std::size_t n = 0; n < terms; ++n) coefficients[n] = taylor[n];
  }
};
inline constexpr Series<7> series_for_small(1.0 / 128);
inline constexpr Series<11> series_for_large(1.0 / 16);

/// The force over length of springs of a stiffness k and relative growth p = q / L0^2, all within series_for_small.
template <class Law>
HYPERLATTICE_INLINE Pack pull_near_rest(Pack stiffness, Pack p) {
  constexpr auto& c = series_for_small.coefficients;
  Pack sum = fill(c.back());
  each<c.size() - 1>([&]<std::size_t n>() __attribute__((always_inline)) { sum = sum * p + c[c.size() - 2 - n]; });
  return Law::force(stiffness, sum * p);
}

/// HYPERLATTICE_SPRINGS=exact in the environment asks for root and division everywhere, and for the plainest kernel.
inline bool exact_springs() {
  const char* wish = std::getenv("HYPERLATTICE_SPRINGS");
  return wish != nullptr && std::string_view(wish) == "exact";
}

/// A series in q for springs of a stiffness and a length: the force over length is q times its sum.
template <std::size_t terms>
class ScaledSeries {
 public:
  template <class Law>
  void set(const Series<terms>& series, double stiffness, double rest_length, Law) {
    const double square = rest_length * rest_length;
    double power = 1 / square;
    for (std::size_t n = 0; n < terms; ++n, power /= square) coefficients_[n] = Law::force(stiffness, series.coefficients[n] * power);
    if (power > 1e-300 && power < 1e300) range_ = series.range * square;  // else numbers fail: lattices of 1e-15 m
  }
  double range() const { return range_; }
  double operator[](std::size_t n) const { return coefficients_[n]; }

 private:
  double coefficients_[terms] = {};
  double range_ = -1;  ///< of q; -1: none
};

/// Springs of one class between two materials, base or cross: constants made ready for the loop.
template <class Law>
class SpringKind {
 public:
  SpringKind() = default;
  /// `alarm`: elongation; infinity if nothing asks.
  SpringKind(double stiffness, double rest_length, double alarm) : stiffness_(stiffness), rest_length_(rest_length) {
    if (alarm < infinity) alarm_ = squared_growth(rest_length, alarm);
    if constexpr (is_linear<Law>) {
      small_.set(series_for_small, stiffness, rest_length, Law{});
      large_.set(series_for_large, stiffness, rest_length, Law{});
    }
    lowest_ = -small_.range();
    highest_ = alarm_ < small_.range() ? alarm_ : small_.range();
  }

  /// Force over length of several springs at a time. Returns a bit for each that has one above its alarm.
  template <std::size_t number>
  HYPERLATTICE_INLINE static std::uint32_t pull(const SpringKind* const (&kinds)[number], const Pack (&q)[number], Pack (&pull)[number]) {
    Outside outside;
    each<number>([&]<std::size_t s>() __attribute__((always_inline)) { outside.look(q[s], kinds[s]->lowest_, kinds[s]->highest_); });
    if (outside) [[unlikely]] {
      std::uint32_t rung = 0;
      for (std::size_t s = 0; s < number; ++s) {
        pull[s] = kinds[s]->far(q[s]);
        if (any(q[s] > kinds[s]->alarm_)) rung |= 1u << s;
      }
      return rung;
    }
    sum<small_terms>(
        [&](std::size_t s) -> const auto& { return kinds[s]->small_; }, q, pull);
    return 0;
  }

 private:
  static constexpr std::size_t small_terms = series_for_small.coefficients.size(), large_terms = series_for_large.coefficients.size();

  /// q times the series in q, side by side.
  template <std::size_t terms, std::size_t number, class SeriesOf>
  HYPERLATTICE_INLINE static void sum(const SeriesOf& series, const Pack (&q)[number], Pack (&pull)[number]) {
    each<number>([&]<std::size_t s>() __attribute__((always_inline)) { pull[s] = fill(series(s)[terms - 1]); });
    each<terms - 1>([&]<std::size_t n>() __attribute__((always_inline)) {
      each<number>([&]<std::size_t s>() __attribute__((always_inline)) { pull[s] = pull[s] * q[s] + series(s)[terms - 2 - n]; });
    });
    each<number>([&]<std::size_t s>() __attribute__((always_inline)) { pull[s] *= q[s]; });
  }

  /// Springs that are not all near their rest length.
  [[gnu::noinline]] Pack far(Pack q) const {
    Outside outside;
    outside.look(q, -large_.range(), large_.range());
    if (outside) return respond<Law, false>(fill(stiffness_), rest_length_, q).force_over_length;
    const Pack growth[1] = {q};
    Pack result[1];
    sum<large_terms>(
        [&](std::size_t) -> const auto& { return large_; }, growth, result);
    return result[0];
  }

  ScaledSeries<small_terms> small_;
  double lowest_ = 1, highest_ = -1;  ///< growth within which the short series holds and nothing rings
  ScaledSeries<large_terms> large_;
  double alarm_ = infinity;  ///< growth
  double stiffness_ = 0, rest_length_ = 0;
};

}  // namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS
