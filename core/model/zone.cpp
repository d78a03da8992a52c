// The phases t_i = q . a_i of a wave have the period 2 pi, for any basis. With the matrix A, whose
// columns are the basis, q = A^-T t, and a symmetry q -> S q of the lattice maps phases to A^T S
// A^-T t. This is a matrix of integers, so a grid of phases is mapped onto itself.
#include <model/zone.hpp>

#include <Eigen/Dense>

#include <optional>

namespace hyperlattice {

namespace {

constexpr double nearby = 1e-6;  // in units of the spacing

Eigen::Vector3d vector(Vec3 v) { return {v.x, v.y, v.z}; }

Eigen::Matrix3d matrix(const Basis& basis) {
  Eigen::Matrix3d columns;
  for (int n = 0; n < 3; ++n) columns.col(n) = vector(basis[static_cast<std::size_t>(n)]);
  return columns;
}

/// Returns the 48 symmetries of a cube: permutations and reflections of the axes.
std::vector<Eigen::Matrix3d> operations_of_a_cube() {
  std::vector<Eigen::Matrix3d> all;
  std::array<int, 3> axes{0, 1, 2};
  do
    for (int signs = 0; signs < 8; ++signs) {
      Eigen::Matrix3d operation = Eigen::Matrix3d::Zero();
      for (int n = 0; n < 3; ++n)
        operation(n, axes[static_cast<std::size_t>(n)]) = (signs >> n & 1) != 0 ? -1 : 1;
      all.push_back(operation);
    }
  while (std::next_permutation(axes.begin(), axes.end()));
  return all;
}

/// Returns whether the operation maps every spring onto a spring of its class.
bool keeps_springs(const Eigen::Matrix3d& operation, const InfiniteLattice& lattice) {
  const auto on_another = [&](const NeighbourGeometry& n) {
    const Eigen::Vector3d turned = operation * vector(n.rest);
    return std::any_of(lattice.neighbours.begin(), lattice.neighbours.end(),
                       [&](const NeighbourGeometry& other) {
                         const Eigen::Vector3d rest = vector(other.rest);
                         return other.site.spring_class == n.site.spring_class &&
                                std::min((turned - rest).norm(), (turned + rest).norm()) <
                                    nearby * lattice.spacing;
                       });
  };
  return std::all_of(lattice.neighbours.begin(), lattice.neighbours.end(), on_another);
}

std::optional<PhaseMap> on_phases(const Eigen::Matrix3d& operation, const Eigen::Matrix3d& basis) {
  const Eigen::Matrix3d acting = basis.transpose() * operation * basis.inverse().transpose();
  PhaseMap map{};
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column) {
      const double exact =
                       acting(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)),
                   whole = std::round(exact);
      if (std::abs(exact - whole) > nearby) return std::nullopt;
      map[row][column] = static_cast<int>(whole);
    }
  return map;
}

}  // namespace

Basis reciprocal(const Basis& basis) {
  const Eigen::Matrix3d columns = matrix(basis).inverse().transpose();
  Basis found;
  for (int n = 0; n < 3; ++n)
    found[static_cast<std::size_t>(n)] = {columns(0, n), columns(1, n), columns(2, n)};
  return found;
}

std::vector<PhaseMap> symmetries(const InfiniteLattice& lattice) {
  std::vector<PhaseMap> found;
  for (const Eigen::Matrix3d& operation : operations_of_a_cube())
    if (keeps_springs(operation, lattice))
      if (const auto map = on_phases(operation, matrix(lattice.basis))) found.push_back(*map);
  return found;
}

const std::array<Vec3, 27>& steps_around() {
  static const std::array<Vec3, 27> steps = [] {
    std::array<Vec3, 27> all;
    std::size_t next = 0;
    for (const double z : {-1, 0, 1})
      for (const double y : {-1, 0, 1})
        for (const double x : {-1, 0, 1}) all[next++] = {x, y, z};
    return all;
  }();
  return steps;
}

Vec3 in_first_zone(const Basis& basis, Vec3 q) {
  constexpr double clearly = 1 - 1e-3;  // of equally long vectors the given one stays
  const Basis b = reciprocal(basis);
  for (bool shorter = true; shorter;) {
    shorter = false;
    for (const Vec3 step : steps_around()) {
      const Vec3 same = q - 2 * pi * combined(b, step.x, step.y, step.z);
      if (norm(same) >= clearly * norm(q)) continue;
      q = same;
      shorter = true;
    }
  }
  return q;
}

std::vector<Vec3> zone_grid(const InfiniteLattice& lattice, int half) {
  const int period = 2 * half;
  const auto wrapped = [period](int n) {
    return static_cast<std::size_t>((n % period + period) % period);
  };
  const auto place = [&](int i, int j, int k) {
    const auto side = static_cast<std::size_t>(period);
    return (wrapped(k) * side + wrapped(j)) * side + wrapped(i);
  };
  const std::vector<PhaseMap> maps = symmetries(lattice);
  const Basis b = reciprocal(lattice.basis);
  std::vector<bool> known(place(-1, -1, -1) + 1);
  std::vector<Vec3> found;
  for (int k = 0; k < period; ++k)
    for (int j = 0; j < period; ++j)
      for (int i = 0; i < period; ++i) {
        if (known[place(i, j, k)]) continue;
        found.push_back(pi / half * combined(b, i, j, k));
        const auto mapped = [&](const std::array<int, 3>& row) {
          return row[0] * i + row[1] * j + row[2] * k;
        };
        for (const PhaseMap& map : maps)
          known[place(mapped(map[0]), mapped(map[1]), mapped(map[2]))] = true;
      }
  return found;
}

}  // namespace hyperlattice
