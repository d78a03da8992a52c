#include <equilibrium/volume_tangents.hpp>

#include <algorithm>

namespace hyperlattice::equilibrium {

VolumeTangents::VolumeTangents(const StaticProblem& problem)
    : problem_(problem), tetrahedra_(problem.grid.tetrahedra) {
  if (empty()) return;
  const auto places = static_cast<std::size_t>(problem.grid.places);
  std::vector<std::vector<std::int64_t>> around(places);
  for (const StaticTetrahedron& tetrahedron : tetrahedra_)
    for (const std::uint32_t corner : tetrahedron)
      around[corner].insert(around[corner].end(), tetrahedron.begin(), tetrahedron.end());
  first_.reserve(places + 1);
  first_.push_back(0);
  for (std::vector<std::int64_t>& of : around) {
    std::sort(of.begin(), of.end());
    of.erase(std::unique(of.begin(), of.end()), of.end());
    around_.insert(around_.end(), of.begin(), of.end());
    first_.push_back(around_.size());
  }
  stiffness_.resize(places);
  pressure_.resize(places);
}

/// Returns the corners relative to the first one, in lattice constants.
std::array<Vec3, 4> VolumeTangents::places_of(const StaticTetrahedron& tetrahedron,
                                              const Field& displacement) const {
  const auto places = static_cast<std::size_t>(problem_.grid.places);
  const auto moved = [&](std::size_t place) {
    return Vec3{displacement[place], displacement[places + place],
                displacement[2 * places + place]};
  };
  const Vec3 first = problem_.position(tetrahedron[0]), first_moved = moved(tetrahedron[0]);
  std::array<Vec3, 4> corners;
  for (std::size_t n = 1; n < 4; ++n)
    corners[n] =
        ((problem_.position(tetrahedron[n]) - first) + (moved(tetrahedron[n]) - first_moved)) /
        problem_.grid.spacing;
  return corners;
}

/// Adds a quarter of the gradients of a tetrahedron to those of the volumes of its corners.
void VolumeTangents::add_gradients(const StaticTetrahedron& tetrahedron,
                                   const std::array<Vec3, 4>& corners,
                                   std::vector<Vec3>& gradients) const {
  const Vec3 b = (1.0 / 24) * cross(corners[2], corners[3]),
             c = (1.0 / 24) * cross(corners[3], corners[1]),
             d = (1.0 / 24) * cross(corners[1], corners[2]);
  const std::array<Vec3, 4> quarters = {-(b + c + d), b, c, d};
  for (const std::uint32_t place : tetrahedron) {
    const auto begin = around_.begin() + static_cast<std::ptrdiff_t>(first_[place]),
               end = around_.begin() + static_cast<std::ptrdiff_t>(first_[place + std::size_t{1}]);
    for (std::size_t n = 0; n < 4; ++n) {
      const auto at = std::lower_bound(begin, end, std::int64_t{tetrahedron[n]});
      gradients[static_cast<std::size_t>(at - around_.begin())] += quarters[n];
    }
  }
}

double VolumeTangents::mean_pressure(const StaticTetrahedron& tetrahedron) const {
  double sum = 0;
  for (const std::uint32_t place : tetrahedron) sum += static_cast<double>(pressure_[place]);
  return 0.25 * sum;
}

/// Returns the pressure times the second derivative of the volume by the places of the corners m
/// and n: the cross product with a sixth of the vector between the two other corners.
VolumeBlock VolumeTangents::second_derivative(const std::array<Vec3, 4>& corners, std::size_t m,
                                              std::size_t n, double pressure) {
  // (m, n, p, q) is an even permutation of (0, 1, 2, 3): then d2V/dx_m dx_n = (x_p - x_q) x / 6.
  static constexpr std::size_t others[4][4][2] = {{{0, 0}, {2, 3}, {3, 1}, {1, 2}},
                                                  {{3, 2}, {0, 0}, {0, 3}, {2, 0}},
                                                  {{1, 3}, {3, 0}, {0, 0}, {0, 1}},
                                                  {{2, 1}, {0, 2}, {1, 0}, {0, 0}}};
  const Vec3 x = (pressure / 6) * (corners[others[m][n][0]] - corners[others[m][n][1]]);
  return {0, -x.z, x.y, x.z, 0, -x.x, -x.y, x.x, 0};
}

}  // namespace hyperlattice::equilibrium
