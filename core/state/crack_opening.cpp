// The opening of cracks in the field of damage, and the times at which they formed.
//
// A spring of the factor f is two half springs in series with the parts omega_i and omega_j. Of its
// motion r - Q R, with the rotation Q of the particle, the part 1 - f is opening, and 1/2 (1 -
// omega_i) e belongs to the half at i with e = 2 omega_j / (omega_i + omega_j): both halves add up
// to 1 - f. The opening per spacing is the gradient that fits the openings o of the half springs
// R / 2 by least squares,
//   G = 2 (sum k o (x) R) (sum k R (x) R)^-1.
// Its trace is the opening along the normal of a crack, and 0 for a slip inside a body. For a crack
// along a lattice plane the sum over the planes is the jump of displacements, less what is elastic
// in it, whatever its size. Springs at a surface make components of G off the diagonal, not of the
// trace.
#include <state/damage_field.hpp>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <limits>
#include <span>

namespace hyperlattice {

namespace {

/// The least-squares fit of a gradient of deformation to springs.
struct GradientFit {
  Eigen::Matrix3d moved = Eigen::Matrix3d::Zero(), rests = moved;

  void add(double weight, const Eigen::Vector3d& present, const Eigen::Vector3d& rest) {
    moved += weight * present * rest.transpose();
    rests += weight * rest * rest.transpose();
  }
  /// Bodies of one layer or one row of particles have springs along two axes or one.
  Eigen::Matrix3d inverse() const {
    return rests.completeOrthogonalDecomposition().pseudoInverse();
  }
  Eigen::Matrix3d gradient() const { return moved * inverse(); }
};

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
  struct Line {
    Eigen::Vector3d rest, present;    // m
    double stiffness = 0, other = 1;  // N/m; omega of the other end
    bool stretched = false;
  };
  std::array<Line, DamageRecord::most_springs> all;
  std::size_t count = 0;
  for (const DamageSpring& spring : record.springs()) {
    if (!spring.present || !(spring.handed_over || records_.exists(record, spring))) continue;
    const Vec3 rest = records_.direction(spring).rest;
    const Block &here = blocks_[record.block], &there = blocks_[spring.block];
    Line& line = all[count++];
    for (int c = 0; c < 3; ++c) {
      line.rest[c] = rest[static_cast<std::size_t>(c)];
      line.present[c] =
          line.rest[c] + (there.displacement[c][spring.index] - here.displacement[c][record.index]);
    }
    line.stiffness = spring.stiffness[0];
    line.other = records_.remaining_of(spring.to);
    line.stretched = line.present.squaredNorm() > line.rest.squaredNorm();
  }
  const std::span<const Line> lines(all.data(), count);
  // The rotation is that of the springs that hold the particle, if any does.
  constexpr double least_weight = 1e-6;
  GradientFit whole, held;
  for (const Line& line : lines) {
    const double sum = own + line.other, factor = sum > 0 ? 2 * own * line.other / sum : 0;
    whole.add(line.stiffness, line.present, line.rest);
    held.add(line.stiffness * std::max(factor, least_weight), line.present, line.rest);
  }
  const Eigen::Matrix3d rotation = rotation_of(held.gradient()), inverse = whole.inverse();
  double trace = 0;
  for (const Line& line : lines) {
    if (!line.stretched) continue;
    const double sum = own + line.other, part = sum > 0 ? (1 - own) * line.other / sum : 0.5;
    trace += 2 * part * line.stiffness *
             (rotation.transpose() * line.present - line.rest).dot(inverse * line.rest);
  }
  return std::max(0.0, trace) * model_.body.grid.spacing;
}

void DamageField::copy_openings(std::vector<double>& values) const {
  values.assign(model_.body.particles, 0);
  if (empty()) return;
  records_.for_each(records_.order(), [&](std::uint32_t number) {
    values[records_[number].particle] = opening(number);
  });
}

void DamageField::copy_crack_times(std::vector<double>& values) const {
  constexpr double never = std::numeric_limits<double>::quiet_NaN();
  values.assign(model_.body.particles, never);
  if (empty()) return;
  for (const std::uint32_t number : records_.order())
    values[records_[number].particle] = records_[number].crack_time;
}

}  // namespace hyperlattice
