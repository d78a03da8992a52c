#include <model/nearby.hpp>

#include <cmath>

namespace hyperlattice {

Nearby::Nearby(const Body& body) : body_(body), width_(body.grid.spacing) {
  const Cell last = cell_of(body.highest);
  size_ = {last.i + 1, last.j + 1, last.k + 1};
  const auto number = [&](Particle p) {
    const Cell cell = cell_of(body_.position(p));
    return static_cast<std::size_t>((cell.k * size_.j + cell.j) * size_.i + cell.i);
  };
  first_.assign(static_cast<std::size_t>(size_.i * size_.j * size_.k) + 1, 0);
  for (Particle p = 0; p < body.particles; ++p) ++first_[number(p) + 1];
  for (std::size_t n = 1; n < first_.size(); ++n) first_[n] += first_[n - 1];
  std::vector<std::uint64_t> next(first_.begin(), first_.end() - 1);
  sorted_.resize(body.particles);
  for (Particle p = 0; p < body.particles; ++p) sorted_[next[number(p)]++] = p;
}

Nearby::Cell Nearby::cell_of(Vec3 point) const {
  const Vec3 steps = (1 / width_) * (point - body_.lowest);
  return {static_cast<std::int64_t>(std::floor(steps.x)),
          static_cast<std::int64_t>(std::floor(steps.y)),
          static_cast<std::int64_t>(std::floor(steps.z))};
}

std::span<const Particle> Nearby::particles(Cell cell) const {
  if (cell.i < 0 || cell.j < 0 || cell.k < 0 || cell.i >= size_.i || cell.j >= size_.j ||
      cell.k >= size_.k)
    return {};
  const auto number = static_cast<std::size_t>((cell.k * size_.j + cell.j) * size_.i + cell.i);
  return {sorted_.data() + first_[number], sorted_.data() + first_[number + 1]};
}

/// Searches shells of cells until no farther shell can hold a nearer particle. Among equally near
/// particles it returns the first in the order of the particles.
Nearby::Found Nearby::nearest(Vec3 point) const {
  const Cell centre = cell_of(point);
  const auto beyond = [](std::int64_t at, std::int64_t size) {
    return std::max({std::int64_t{0}, -at, at - (size - 1)});
  };
  const std::int64_t first =
      std::max({beyond(centre.i, size_.i), beyond(centre.j, size_.j), beyond(centre.k, size_.k)});
  const std::int64_t last = first + std::max({size_.i, size_.j, size_.k});
  Found found;
  for (std::int64_t shell = first;
       shell <= last && static_cast<double>(shell - 1) * width_ <= found.distance; ++shell)
    for (std::int64_t k = -shell; k <= shell; ++k)
      for (std::int64_t j = -shell; j <= shell; ++j) {
        const bool on_shell = std::max(std::abs(k), std::abs(j)) == shell;
        for (std::int64_t i = -shell; i <= shell; i += on_shell || shell == 0 ? 1 : 2 * shell)
          for (const Particle p : particles({centre.i + i, centre.j + j, centre.k + k})) {
            const double distance = norm(body_.position(p) - point);
            if (distance < found.distance || (distance == found.distance && p < found.particle))
              found = {p, distance};
          }
      }
  return found;
}

}  // namespace hyperlattice
