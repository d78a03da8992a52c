#include <state/cell_stress.hpp>
#include <state/corner_means.hpp>
#include <state/particle_strain.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hyperlattice {

namespace {

Symmetric no_symmetric() {
  Symmetric none;
  none.fill(std::numeric_limits<double>::quiet_NaN());
  return none;
}

bool is_finite(const Symmetric& tensor) {
  return std::all_of(tensor.begin(), tensor.end(), [](double x) { return std::isfinite(x); });
}

Eigen::Matrix3d matrix(const Symmetric& t) {
  Eigen::Matrix3d m;
  m << t[0], t[5], t[4], t[5], t[1], t[3], t[4], t[3], t[2];
  return m;
}

/// The least-squares fit of a gradient to springs.
struct Fit {
  Tensor differences, spread;  ///< sum w f (x) R and sum w R (x) R

  void add(double weight, Vec3 difference, Vec3 rest) {
    differences += outer(weight * difference, rest);
    spread += outer(weight * rest, rest);
  }
  Tensor gradient() const {
    constexpr double flattest = 0.05;  // least eigenvalue of the spread over the largest
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix(symmetric_part(spread)),
                                                                Eigen::EigenvaluesOnly);
    const Eigen::Vector3d& values = solver.eigenvalues();
    if (!(values[0] >= flattest * values[2] && values[2] > 0)) return no_tensor;
    const Tensor inverse = 1 / determinant(spread) * cofactor(spread);  // it is symmetric
    return differences * inverse;
  }
};

/// Fits the gradients of those particles that have none.
void fit_others(const PresentSprings& springs, std::span<const double> xyz,
                const std::vector<std::uint32_t>& fit_of, std::vector<Fit>& fits) {
  constexpr auto none = ~std::uint32_t{0};
  const double per_spacing = 1 / springs.model().body.grid.spacing;
  springs.for_springs(Asked::motion, [&](const PresentSpring& spring) {
    for (const Particle end : {spring.a, spring.b}) {
      if (fit_of[end] == none) continue;
      const double *a = &xyz[3 * spring.a], *b = &xyz[3 * spring.b];
      fits[fit_of[end]].add(spring.share, {b[0] - a[0], b[1] - a[1], b[2] - a[2]},
                            per_spacing * spring.rest);
    }
  });
}

}  // namespace

std::vector<Tensor> gradients(const PresentSprings& springs, std::span<const double> xyz) {
  const Body& body = springs.model().body;
  CornerMeans<Tensor> means(body.particles);
  for_cells(springs, Asked::motion, [&](const PresentCell& cell) {
    if (cell.is_whole) means.add(cell, gradient_in(cell, xyz, body.grid.spacing));
  });
  std::vector<std::uint32_t> fit_of(body.particles, ~std::uint32_t{0});
  std::vector<Particle> others;
  for (Particle p = 0; p < body.particles; ++p)
    if (!means.has(p)) {
      fit_of[p] = static_cast<std::uint32_t>(others.size());
      others.push_back(p);
    }
  std::vector<Tensor> all = means.take(no_tensor);
  if (others.empty()) return all;
  std::vector<Fit> fits(others.size());
  fit_others(springs, xyz, fit_of, fits);
  for (std::size_t n = 0; n < others.size(); ++n)
    all[others[n]] = 1 / body.grid.spacing * fits[n].gradient();
  return all;
}

Symmetric green_lagrange_strain(const Tensor& H) {
  return symmetric_part(H + 0.5 * (transposed(H) * H));
}

Symmetric hencky_strain(const Tensor& H) {
  const Principal of = principal(green_lagrange_strain(H));
  if (!(of.values.z > -0.5)) return no_symmetric();
  Tensor sum;
  for (std::size_t n = 0; n < 3; ++n)
    sum += outer(0.5 * std::log1p(2 * of.values[n]) * of.directions[n], of.directions[n]);
  return symmetric_part(sum);
}

Symmetric strain_rate(const Tensor& H, const Tensor& H_per_second) {
  const Tensor F = identity + H;
  const double J = determinant(F);
  if (J == 0) return no_symmetric();
  return symmetric_part(H_per_second * (1 / J * transposed(cofactor(F))));
}

Principal principal(const Symmetric& tensor) {
  if (!is_finite(tensor)) return {no_tensor[0], no_tensor};
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix(tensor));
  Principal found;
  for (std::size_t n = 0; n < 3; ++n) {
    const auto from = static_cast<Eigen::Index>(2 - n);  // Eigen's order ascends
    found.values[n] = solver.eigenvalues()[from];
    const Eigen::Vector3d way = solver.eigenvectors().col(from);
    Eigen::Index largest = 0;
    way.cwiseAbs().maxCoeff(&largest);
    const double sign = way[largest] < 0 ? -1 : 1;
    found.directions[n] = {sign * way[0], sign * way[1], sign * way[2]};
  }
  return found;
}

}  // namespace hyperlattice
