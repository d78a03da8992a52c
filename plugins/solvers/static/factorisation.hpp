// The factorisation of a sparse symmetric matrix, which does not fail silently.
#pragma once

#include <Eigen/SparseCholesky>

namespace hyperlattice::statics {

class Factorisation {
 public:
  /// L D L^T of a matrix of which the lower triangle is read. Its diagonal is first made larger by the share `shift` of itself, as nothing may hold
  /// the body, and by more where a pivot vanishes all the same. Throws std::runtime_error if none of that helps.
  void compute(const Eigen::SparseMatrix<double>& matrix, double shift);
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const { return factors_.solve(b); }

 private:
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors_;
};

}  // namespace hyperlattice::statics
