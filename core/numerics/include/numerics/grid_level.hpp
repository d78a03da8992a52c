// One level of a geometric multigrid: a matrix K on a box of sites with up to four numbers for each
// site, and the layout of these numbers.
#pragma once

#include <numerics/fields.hpp>

#include <array>

namespace hyperlattice::numerics {

/// The layout of the numbers of a box of sites. Component c of site (i, j, k) is at
///   place(i, j, k) * of_place + c * of_component.
/// A margin of zeros surrounds the box.
struct GridLayout {
  std::array<std::int64_t, 3> sites{};
  std::int64_t row = 0, plane = 0, origin = 0, places = 0;
  std::int64_t of_place = 1, of_component = 1;
  int components = 4;

  std::int64_t place(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return origin + i + j * row + k * plane;
  }
  /// Calls visit(i, j, k) for all sites, in the order of the box.
  template <class Visit>
  void for_sites(const Visit& visit) const {
    for (std::int64_t k = 0; k < sites[2]; ++k)
      for (std::int64_t j = 0; j < sites[1]; ++j)
        for (std::int64_t i = 0; i < sites[0]; ++i) visit(i, j, k);
  }
  /// Calls visit(begin, end) for the ranges of a field that belong to places [first, last).
  template <class Visit>
  void for_numbers(std::size_t first, std::size_t last, const Visit& visit) const {
    const auto of = static_cast<std::size_t>(of_place),
               apart = static_cast<std::size_t>(of_component);
    if (of_place > 1) return visit(of * first, of * last);
    for (std::size_t c = 0; c < static_cast<std::size_t>(components); ++c)
      visit(c * apart + first, c * apart + last);
  }
  std::size_t numbers() const {
    return static_cast<std::size_t>(places) *
           static_cast<std::size_t>(of_place == 1 ? components : of_place);
  }
};

class GridLevel {
 public:
  explicit GridLevel(const GridLayout& layout, int threads) : layout_(layout), threads_(threads) {}
  virtual ~GridLevel() = default;
  GridLevel(const GridLevel&) = delete;
  GridLevel& operator=(const GridLevel&) = delete;

  /// Computes y = K x.
  virtual void multiply(const double* x, double* y) const = 0;
  /// Computes z = D^-1 r at places [first, last), D the diagonal blocks of K; 0 for components that
  /// cannot move.
  virtual void divide(std::size_t first, std::size_t last, const double* r, double* z) const = 0;
  /// Sets components that cannot move to zero.
  virtual void mask(double* x) const = 0;
  /// Bound or good estimate of the largest eigenvalue of D^-1 K.
  virtual double largest_eigenvalue() const = 0;

  const GridLayout& layout() const { return layout_; }
  int threads() const { return threads_; }

 protected:
  /// Returns the largest eigenvalue of D^-1 K by the power method, |D^-1 K x| / |x|, times a safety
  /// factor of 1.2; for K = 0 the factor alone. Never throws.
  double power_iteration() const;

  GridLayout layout_;
  int threads_;

 private:
  void clear_margin(Field& x) const;
};

}  // namespace hyperlattice::numerics
