// Phases t_i = q . a_i of a wave have the period 2 pi, whatever the basis. With A the matrix whose columns are the basis, q = A^-T t, and a symmetry
// q -> S q of the lattice takes phases to A^T S A^-T t, a matrix of integers: it maps a grid of phases onto itself.
#include <model/zone.hpp>

#include <Eigen/Dense>

#include <optional>

namespace hyperlattice {

namespace {

constexpr double nearby = 1e-6;  // of a spacing

Eigen::Vector3d vector(Vec3 v) { return {v.x, v.y, v.z}; }

Eigen::Matrix3d matrix(const Basis& basis) {
  Eigen::Matrix3d columns;
  for (int n = 0; n < 3; ++n) columns.col(n) = vector(basis[static_cast<std::size_t>(n)]);
  return columns;
}

/// The 48 operations of a cube: axes swapped and reversed.
std::vector<Eigen::Matrix3d> operations_of_a_cube() {
  std::vector<Eigen::Matrix3d> all;
  std::array<int, 3> axes{0, 1, 2};
  do
    for (int signs = 0; signs < 8; ++signs) {
      Eigen::Matrix3d operation = Eigen::Matrix3d::Zero();
      for (int n = 0; n < 3; ++n) operation(n, axes[static_cast<std::size_t>(n)]) = (signs >> n & 1) != 0 ? -1 : 1;
      all.push_back(operation);
    }
  while (std::next_permutation(axes.begin(), axes.end()));
  return all;
}

/// Whether every spring comes to lie on one of its class.
bool keeps_springs(const Eigen::Matrix3d& operation, const InfiniteLattice& lattice) {
  const auto on_another = [&](const NeighbourGeometry& n) {
    const Eigen::Vector3d turned = operation * vector(n.rest);
    return std::any_of(lattice.neighbours.begin(), lattice.neighbours.end(), [&](const NeighbourGeometry& other) {
      const Eigen::Vector3d rest = vector(other.rest);
      return other.site.spring_class == n.site.spring_class && std::min((turned - rest).norm(), (turned + rest).norm()) < nearby * lattice.spacing;
    });
  };
  return std::all_of(lattice.neighbours.begin(), lattice.neighbours.end(), on_another);
}

std::optional<PhaseMap> on_phases(const Eigen::Matrix3d& operation, const Eigen::Matrix3d& basis) {
  const Eigen::Matrix3d acting = basis.transpose() * operation * basis.inverse().transpose();
  PhaseMap map{};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      const double whole = std::round(acting(row, column));
      if (std::abs(acting(row, column) - whole) > nearby) return std::nullopt;
      map[static_cast<std::size_t>(3 * row + column)] = static_cast<int>(whole);
    }
  return map;
}

}  // namespace

Basis reciprocal(const Basis& basis) {
  const Eigen::Matrix3d columns = matrix(basis).inverse().transpose();
  Basis found;
  for (int n = 0; n < 3; ++n) found[static_cast<std::size_t>(n)] = {columns(0, n), columns(1, n), columns(2, n)};
  return found;
}

std::vector<PhaseMap> symmetries(const InfiniteLattice& lattice) {
  std::vector<PhaseMap> found;
  for (const Eigen::Matrix3d& operation : operations_of_a_cube())
    if (keeps_springs(operation, lattice))
      if (const auto map = on_phases(operation, matrix(lattice.basis))) found.push_back(*map);
  return found;
}

Vec3 in_first_zone(const Basis& basis, Vec3 q) {
  constexpr double clearly = 1 - 1e-3;  // of two equal ones, the one that was given
  const Basis b = reciprocal(basis);
  for (bool shorter = true; shorter;) {
    shorter = false;
    for (int n = 0; n < 27; ++n) {
      const Vec3 same = q - 2 * pi * combined(b, n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
      if (norm(same) >= clearly * norm(q)) continue;
      q = same;
      shorter = true;
    }
  }
  return q;
}

std::vector<Vec3> zone_grid(const InfiniteLattice& lattice, int half) {
  const int period = 2 * half;
  const auto place = [period](int i, int j, int k) { return static_cast<std::size_t>((k * period + j) * period + i); };
  const auto wrapped = [period](int n) { return (n % period + period) % period; };
  const std::vector<PhaseMap> maps = symmetries(lattice);
  const Basis b = reciprocal(lattice.basis);
  std::vector<bool> known(place(0, 0, period));
  std::vector<Vec3> found;
  for (int k = 0; k < period; ++k)
    for (int j = 0; j < period; ++j)
      for (int i = 0; i < period; ++i) {
        if (known[place(i, j, k)]) continue;
        found.push_back(pi / half * combined(b, i, j, k));
        for (const PhaseMap& m : maps)
          known[place(wrapped(m[0] * i + m[1] * j + m[2] * k), wrapped(m[3] * i + m[4] * j + m[5] * k), wrapped(m[6] * i + m[7] * j + m[8] * k))] =
              true;
      }
  return found;
}

}  // namespace hyperlattice
