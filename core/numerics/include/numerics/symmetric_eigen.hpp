// Eigenvalues and eigenvectors of a small dense symmetric matrix, A = Q Lambda Q^T, by tridiagonal
// QR (Golub and Van Loan 2013, section 8.3, as in Eigen). Throws if the iteration fails.
#pragma once

#include <Eigen/Eigenvalues>

#include <stdexcept>
#include <string>

namespace hyperlattice::numerics {

template <class Matrix>
class SymmetricEigen {
 public:
  /// Solves for a matrix, of which it reads the lower triangle. options: Eigen::EigenvaluesOnly, or
  /// vectors too. Throws std::runtime_error if the iteration does not converge, as for a matrix
  /// with NaN; with infinite numbers the eigenvalues may be NaN.
  explicit SymmetricEigen(const Matrix& A, int options = Eigen::ComputeEigenvectors)
      : solver_(A, options) {
    if (solver_.info() != Eigen::Success)
      throw std::runtime_error("the eigenvalues of a symmetric matrix of " +
                               std::to_string(A.rows()) +
                               " rows cannot be found: it may not be finite");
  }

  const auto& eigenvalues() const { return solver_.eigenvalues(); }    ///< ascending, in A's unit
  const auto& eigenvectors() const { return solver_.eigenvectors(); }  ///< the columns of Q

 private:
  Eigen::SelfAdjointEigenSolver<Matrix> solver_;
};

}  // namespace hyperlattice::numerics
