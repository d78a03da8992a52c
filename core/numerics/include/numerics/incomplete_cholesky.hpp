// A preconditioner from the entries of a sparse symmetric matrix: A is about L L^T, where L has no
// entry where A has none (Lin and More 1999, as in Eigen, which scales the matrix and shifts its
// diagonal itself).
#pragma once

#include <Eigen/IterativeLinearSolvers>

namespace hyperlattice::numerics {

class IncompleteCholesky {
 public:
  /// Factorises a matrix, of which it reads the lower triangle. Returns false if there is no
  /// factor. Does not detect numbers that are not finite: solve() then returns such numbers.
  [[nodiscard]] bool compute(const Eigen::SparseMatrix<double>& matrix) {
    factor_.compute(matrix);
    return factor_.info() == Eigen::Success;
  }
  /// Returns about A^-1 b. Call it only after compute() has returned true.
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const { return factor_.solve(b); }

 private:
  Eigen::IncompleteCholesky<double> factor_;
};

}  // namespace hyperlattice::numerics
