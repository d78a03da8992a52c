// Parallel arithmetic on fields. Sums use fixed pieces in a fixed order, so results do not depend
// on the number of threads.
#pragma once

#include <hyperlattice/array_memory.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hyperlattice::numerics {

using Field = std::vector<double, ArrayMemory<double>>;
using Floats = std::vector<float, ArrayMemory<float>>;

/// Calls work(first, last) for pieces of [0, size), in several threads.
template <std::size_t piece = 8192, class Work>
void in_pieces(std::size_t size, int threads, const Work& work) {
  const auto pieces = static_cast<std::int64_t>((size + piece - 1) / piece);
#pragma omp parallel for num_threads(threads) schedule(static) if (threads > 1)
  for (std::int64_t n = 0; n < pieces; ++n) {
    const std::size_t first = static_cast<std::size_t>(n) * piece;
    work(first, std::min(size, first + piece));
  }
}

/// Returns the sum of part(first, last) over the pieces.
template <class Part>
double sum_of_pieces(std::size_t size, int threads, const Part& part) {
  constexpr std::size_t piece = 8192;
  std::vector<double> parts((size + piece - 1) / piece);
  in_pieces(size, threads,
            [&](std::size_t first, std::size_t last) { parts[first / piece] = part(first, last); });
  double sum = 0;
  for (const double p : parts) sum += p;
  return sum;
}

template <class Real>
double product(const Real* a, const Real* b, std::size_t size, int threads) {
  return sum_of_pieces(size, threads, [&](std::size_t first, std::size_t last) {
    double sum[8] = {};
    std::size_t n = first;
    for (; n + 8 <= last; n += 8)
      for (std::size_t lane = 0; lane < 8; ++lane)
        sum[lane] += static_cast<double>(a[n + lane]) * static_cast<double>(b[n + lane]);
    for (; n < last; ++n) sum[0] += static_cast<double>(a[n]) * static_cast<double>(b[n]);
    return ((sum[0] + sum[1]) + (sum[2] + sum[3])) + ((sum[4] + sum[5]) + (sum[6] + sum[7]));
  });
}

/// Returns the largest magnitude; infinity if a number is NaN.
inline double largest(const Field& a) {
  double found = 0;
  for (const double value : a) {
    const double size = std::abs(value);
    if (!(size <= found)) found = std::isnan(size) ? HUGE_VAL : size;
  }
  return found;
}

inline double largest_magnitude(const Floats& a) {
  float found = 0;
  for (const float value : a) found = std::max(found, std::abs(value));
  return static_cast<double>(found);
}

/// Returns the largest power of two up to `size`; 1 if it is zero or not finite.
inline double power_of_two(double size) {
  return size > 0 && std::isfinite(size) ? std::exp2(std::ilogb(size)) : 1;
}

}  // namespace hyperlattice::numerics
