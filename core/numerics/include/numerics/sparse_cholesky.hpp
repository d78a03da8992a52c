// Direct solution of A x = b, A sparse and symmetric, by P A P^T = L D L^T with a fill-reducing
// order P (Eigen's simplicial LDL^T, after Davis 2005). Throws on every failure.
#pragma once

#include <Eigen/SparseCholesky>

namespace hyperlattice::numerics {

class SparseCholesky {
 public:
  /// Factorises a matrix, of which it reads the lower triangle. First raises the diagonal by the
  /// fraction `shift`, because the body may not be held, and by more if a pivot still vanishes.
  /// Throws std::runtime_error if that does not help: the matrix is not finite, or has a zero
  /// pivot.
  void compute(const Eigen::SparseMatrix<double>& matrix, double shift);
  /// Returns x. Throws std::runtime_error without a successful last compute().
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

 private:
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors_;
  bool computed_ = false;
};

}  // namespace hyperlattice::numerics
