#include "local_motion.hpp"

#include <Eigen/Eigenvalues>

namespace hyperlattice::render {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d eigen(const Matrix& rows) {
  Matrix3d matrix;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      matrix(row, column) = rows[static_cast<std::size_t>(row)][column];
  return matrix;
}

}  // namespace

Matrix LocalMotion::gradient() const {
  constexpr double least = 0.05;  // of the largest eigenvalue, for a direction that has neighbours
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(eigen(moment_));
  const Vector3d& values = solver.eigenvalues();  // rising
  const Matrix3d& axes = solver.eigenvectors();
  const Matrix3d moved = eigen(moved_);
  Matrix3d images = axes;  // of the axes
  int known = 0;
  for (int n = 2; n >= 0 && values[n] > least * values[2]; --n, ++known)
    images.col(n) = moved * axes.col(n) / values[n];
  const double sign = axes.determinant() > 0 ? 1 : -1;
  if (known == 2) {
    const Vector3d normal = sign * images.col(1).cross(images.col(2));
    if (normal.norm() > 0) images.col(0) = normal.normalized();
  } else if (known == 1 && images.col(2).norm() > 0) {
    const auto turn = Eigen::Quaterniond::FromTwoVectors(axes.col(2), images.col(2));
    images.col(0) = turn * axes.col(0);
    images.col(1) = turn * axes.col(1);
  }
  const Matrix3d gradient = images * axes.transpose();
  Matrix rows;
  for (int row = 0; row < 3; ++row)
    rows[static_cast<std::size_t>(row)] = {gradient(row, 0), gradient(row, 1), gradient(row, 2)};
  return rows;
}

}  // namespace hyperlattice::render
