// The largest eigenvalue of a symmetric operator by Lanczos's method (Golub and Van Loan 2013,
// section 10.1).
#pragma once

#include <numerics/symmetric_eigen.hpp>

#include <Eigen/Dense>

#include <cmath>

namespace hyperlattice::numerics {

/// Returns the largest eigenvalue of A in the space of the start x and its `products` first
/// products with A: a lower bound of the largest of all, in A's unit. times(x): A x.
template <class Times>
double lanczos_largest(Eigen::VectorXd now, int products, const Times& times) {
  now.normalize();
  Eigen::VectorXd before = Eigen::VectorXd::Zero(now.size());
  Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(products), beside = diagonal;
  int count = 0;
  while (count < products) {
    Eigen::VectorXd next = times(now);
    diagonal[count] = next.dot(now);
    next -= diagonal[count] * now;
    if (count > 0) next -= beside[count - 1] * before;
    const double length = next.norm();
    beside[count++] = length;
    if (!(length > 1e-12 * std::abs(diagonal[0]))) break;  // the space has no more dimensions
    before = now;
    now = next / length;
  }
  Eigen::MatrixXd small = Eigen::MatrixXd::Zero(count, count);
  small.diagonal() = diagonal.head(count);
  if (count > 1) small.diagonal(-1) = beside.head(count - 1);
  return SymmetricEigen<Eigen::MatrixXd>(small, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

}  // namespace hyperlattice::numerics
