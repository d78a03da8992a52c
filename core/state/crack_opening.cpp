// The opening of cracks in the field of damage, and the times at which they formed.
//
// A spring of the factor f is two half springs in series with the parts omega_i and omega_j. Of its
// motion r - Q R, with the rotation Q of the particle, the part 1 - f is opening, and 1/2 (1 -
// omega_i) e belongs to the half at i with e = 2 omega_j / (omega_i + omega_j): both halves add up
// to 1 - f. The opening per spacing is the gradient that fits the openings o of the half springs
// R / 2 by least squares,
//   G = 2 (sum k o (x) R) (sum k R (x) R)^-1.
// For a crack along a lattice plane the sum of G over the planes is the jump of displacements, less
// what is elastic in it, whatever its size.
#include <state/damage_field.hpp>

#include <Eigen/Dense>
#include <algorithm>
#include <limits>

namespace hyperlattice {

namespace {

Eigen::Vector3d vector(Vec3 of) { return {of.x, of.y, of.z}; }

/// Returns the rotation that is nearest to a gradient of deformation, of any rank.
Eigen::Matrix3d rotation_of(const Eigen::Matrix3d& gradient) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> parts(gradient,
                                                Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d left = parts.matrixU();
  if ((left * parts.matrixV().transpose()).determinant() < 0) left.col(2) *= -1;
  return left * parts.matrixV().transpose();
}

}  // namespace

double DamageField::opening(std::uint32_t number) const {
  const DamageRecord& record = records_[number];
  const double own = records_.remaining(number);
  if (own == 1) return 0;
  const auto exists = [&](const DamageSpring& spring) {
    return spring.present && (spring.handed_over || records_.exists(record, spring));
  };
  const auto jump = [&](const DamageSpring& spring) {
    const Block &here = blocks_[record.block], &there = blocks_[spring.block];
    Eigen::Vector3d d;
    for (int c = 0; c < 3; ++c)
      d[c] = there.displacement[c][spring.index] - here.displacement[c][record.index];
    return d;
  };
  Eigen::Matrix3d rests = Eigen::Matrix3d::Zero(), moved = rests, opened = rests;
  for (const DamageSpring& spring : record.springs()) {
    if (!exists(spring)) continue;
    const Eigen::Vector3d rest = vector(spring.rest);
    rests += spring.stiffness[0] * rest * rest.transpose();
    moved += spring.stiffness[0] * (rest + jump(spring)) * rest.transpose();
  }
  // Bodies of one layer or one row of particles have springs along two axes or one.
  const Eigen::Matrix3d inverse = rests.completeOrthogonalDecomposition().pseudoInverse();
  const Eigen::Matrix3d rotation = rotation_of(moved * inverse);
  for (const DamageSpring& spring : record.springs()) {
    const Eigen::Vector3d rest = vector(spring.rest), r = rest + jump(spring);
    if (!exists(spring) || !(r.squaredNorm() > rest.squaredNorm())) continue;
    const double other = records_.remaining_of(spring.to),
                 part = own + other > 0 ? (1 - own) * other / (own + other) : 0.5;
    opened += 2 * part * spring.stiffness[0] * (r - rotation * rest) * rest.transpose();
  }
  const Eigen::Matrix3d gradient = rotation.transpose() * opened * inverse;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(
      (gradient + gradient.transpose()) / 2, Eigen::EigenvaluesOnly);
  return std::max(0.0, principal.eigenvalues()[2]) * model_.body.grid.spacing;
}

void DamageField::copy_openings(std::vector<double>& values) const {
  values.assign(model_.body.particles, 0);
  if (empty()) return;
  records_.for_each(
      [&](std::uint32_t number) { values[records_[number].particle] = opening(number); });
}

void DamageField::copy_crack_times(std::vector<double>& values) const {
  constexpr double never = std::numeric_limits<double>::quiet_NaN();
  values.assign(model_.body.particles, never);
  if (empty()) return;
  for (const std::uint32_t number : records_.order())
    values[records_[number].particle] = records_[number].crack_time;
}

}  // namespace hyperlattice
