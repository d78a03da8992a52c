#include <numerics/grid_level.hpp>
#include <numerics/random_stream.hpp>

namespace hyperlattice::numerics {

double GridLevel::power_iteration() const {
  const std::size_t size = layout_.numbers();
  Field x(size, 0), y(size, 0), z(size, 0);
  RandomStream random;
  for (double& value : x) value = random.next();
  clear_margin(x);
  constexpr int iterations = 8;
  double growth = 1;
  for (int n = 0; n < iterations; ++n) {
    multiply(x.data(), y.data());
    divide(0, static_cast<std::size_t>(layout_.places), y.data(), z.data());
    const double norm = std::sqrt(product(z.data(), z.data(), size, threads_));
    if (!(norm > 0)) break;
    growth = norm / std::sqrt(product(x.data(), x.data(), size, threads_));
    for (std::size_t m = 0; m < size; ++m) x[m] = z[m] / norm;
  }
  constexpr double safety = 1.2;  // the estimates approach the eigenvalue from below
  return safety * growth;
}

/// Sets to zero all numbers that are not at sites of the box, or cannot move.
void GridLevel::clear_margin(Field& x) const {
  std::vector<bool> inside(static_cast<std::size_t>(layout_.places), false);
  layout_.for_sites([&](std::int64_t i, std::int64_t j, std::int64_t k) {
    inside[static_cast<std::size_t>(layout_.place(i, j, k))] = true;
  });
  const auto components = static_cast<std::int64_t>(layout_.numbers()) / layout_.places;
  for (std::int64_t p = 0; p < layout_.places; ++p)
    for (std::int64_t c = 0; c < components && !inside[static_cast<std::size_t>(p)]; ++c)
      x[static_cast<std::size_t>(p * layout_.of_place + c * layout_.of_component)] = 0;
  mask(x.data());
}

}  // namespace hyperlattice::numerics
