#include <numerics/sparse_cholesky.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace hyperlattice::numerics {

void SparseCholesky::compute(const Eigen::SparseMatrix<double>& matrix, double shift) {
  constexpr double most = 1e-2, more = 100;
  computed_ = false;
  const Eigen::VectorXd diagonal = matrix.diagonal();
  for (double added = shift; added <= most; added *= more) {
    Eigen::SparseMatrix<double> shifted = matrix;
    for (Eigen::Index row = 0; row < matrix.rows(); ++row)
      shifted.coeffRef(row, row) = diagonal[row] * (1 + added);
    factors_.compute(shifted);
    computed_ = factors_.info() == Eigen::Success && factors_.vectorD().allFinite();
    if (computed_) return;
  }
  throw std::runtime_error("the stiffness of " + std::to_string(matrix.rows()) +
                           " numbers cannot be factorised: " +
                           (diagonal.allFinite() ? "a pivot is zero" : "it is not finite"));
}

Eigen::VectorXd SparseCholesky::solve(const Eigen::VectorXd& b) const {
  if (!computed_) throw std::runtime_error("a matrix without a factorisation is solved with");
  return factors_.solve(b);
}

}  // namespace hyperlattice::numerics
