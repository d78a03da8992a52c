#include "interpolation.hpp"

#include <hyperlattice/fields.hpp>

#include <Eigen/Eigenvalues>

namespace hyperlattice::line {

namespace {

Eigen::Vector3d vector(Vec3 v) { return {v.x, v.y, v.z}; }

/// Returns the inverse of the covariance matrix of points, with 0 along directions without spread.
Eigen::Matrix3d pseudo_inverse(const Eigen::Matrix3d& spread) {
  constexpr double nothing = 1e-9;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
  if (axes.info() != Eigen::Success) return Eigen::Matrix3d::Zero();  // points that are not finite
  Eigen::Vector3d inverse = Eigen::Vector3d::Zero();
  for (int n = 0; n < 3; ++n)
    if (axes.eigenvalues()[n] > nothing * axes.eigenvalues()[2])
      inverse[n] = 1 / axes.eigenvalues()[n];
  return axes.eigenvectors() * inverse.asDiagonal() * axes.eigenvectors().transpose();
}

}  // namespace

std::vector<Share> shares_at(Vec3 point, double spacing, double radius, const Snapshot& snapshot,
                             const std::vector<Particle>& among) {
  constexpr double sharp = 1e-6;
  std::vector<Share> shares;
  std::vector<Eigen::Vector3d> places;
  double total = 0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const Particle particle : among) {
    const Vec3 apart = (1 / spacing) * (position_of(snapshot, particle) - point);
    const double square = dot(apart, apart),
                 inside = 1 - square * (spacing * spacing) / (radius * radius);
    if (inside <= 0) continue;
    const double weight = inside * inside / (square + sharp);
    shares.push_back({particle, weight});
    places.push_back(vector(apart));
    total += weight;
    centre += weight * places.back();
  }
  centre /= total;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (std::size_t n = 0; n < shares.size(); ++n)
    spread += shares[n].weight * (places[n] - centre) * (places[n] - centre).transpose();
  const Eigen::Vector3d slope = pseudo_inverse(spread) * -centre;  // the point is the origin
  for (std::size_t n = 0; n < shares.size(); ++n)
    shares[n].weight *= 1 / total + slope.dot(places[n] - centre);
  return shares;
}

}  // namespace hyperlattice::line
