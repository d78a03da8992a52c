// Direct solution of A x = b, A sparse and symmetric, by P A P^T = L D L^T with a fill-reducing
// order P (Eigen's simplicial LDL^T, after Davis 2005). It does not fail silently.
#pragma once

#include <Eigen/SparseCholesky>

namespace hyperlattice::numerics {

class SparseCholesky {
 public:
  /// The factors of a matrix of which the lower triangle is read. Its diagonal is first made larger
  /// by the share `shift` of itself, as nothing may hold a body, and by more where a pivot vanishes
  /// all the same. Throws std::runtime_error if none of that helps: the matrix is not finite, or
  /// has a zero pivot.
  void compute(const Eigen::SparseMatrix<double>& matrix, double shift);
  /// x, as long as b, a row of the matrix each. Throws std::runtime_error if there was no
  /// compute(), or the last one failed.
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

 private:
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors_;
  bool computed_ = false;
};

}  // namespace hyperlattice::numerics
