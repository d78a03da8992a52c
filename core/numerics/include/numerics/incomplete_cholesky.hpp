// A preconditioner from the entries of a sparse symmetric matrix alone: A is about L L^T, L with no
// entry where A has none (Lin and More 1999, as Eigen has it; it scales the matrix and shifts its
// diagonal by itself).
#pragma once

#include <Eigen/IterativeLinearSolvers>

namespace hyperlattice::numerics {

class IncompleteCholesky {
 public:
  /// The factor of a matrix of which the lower triangle is read. False: it has none. Numbers that
  /// are not finite go through: solve() gives such then.
  [[nodiscard]] bool compute(const Eigen::SparseMatrix<double>& matrix) {
    factor_.compute(matrix);
    return factor_.info() == Eigen::Success;
  }
  /// About A^-1 b, a number a row. After a compute() that was true.
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const { return factor_.solve(b); }

 private:
  Eigen::IncompleteCholesky<double> factor_;
};

}  // namespace hyperlattice::numerics
