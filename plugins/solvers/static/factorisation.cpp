#include "factorisation.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace hyperlattice::statics {

void Factorisation::compute(const Eigen::SparseMatrix<double>& matrix, double shift) {
  constexpr double most = 1e-2, more = 100;
  const Eigen::VectorXd diagonal = matrix.diagonal();
  for (double added = shift; added <= most; added *= more) {
    Eigen::SparseMatrix<double> shifted = matrix;
    for (Eigen::Index row = 0; row < matrix.rows(); ++row) shifted.coeffRef(row, row) = diagonal[row] * (1 + added);
    factors_.compute(shifted);
    if (factors_.info() == Eigen::Success && factors_.vectorD().allFinite()) return;
  }
  throw std::runtime_error("the stiffness of " + std::to_string(matrix.rows()) +
                           " numbers cannot be factorised: " + (diagonal.allFinite() ? "a pivot is zero" : "it is not finite"));
}

}  // namespace hyperlattice::statics
