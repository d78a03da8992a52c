// A smoother of A x = b: Chebyshev polynomials of D^-1 A, with D the block diagonal of A (Adams et
// al. 2003), and the bound of the largest eigenvalue that they need.
#pragma once

#include <numerics/block_jacobi.hpp>
#include <numerics/linear_operator.hpp>

namespace hyperlattice::numerics {

class ChebyshevSmoother {
 public:
  /// A must outlive this object and must not change.
  ChebyshevSmoother(const LinearOperator& A, BlockJacobi diagonal);

  /// Reduces the error of x in A x = b. from_zero: takes x = 0, whatever it holds.
  void smooth(const Field& b, Field& x, bool from_zero);

  const BlockJacobi& diagonal() const { return diagonal_; }
  /// Returns the blocks for the coarser levels.
  NodeBlocks blocks() const {
    return {
        diagonal_.components(), {diagonal_.inverse().begin(), diagonal_.inverse().end()}, largest_};
  }

 private:
  void estimate_largest();

  const LinearOperator& A_;
  BlockJacobi diagonal_;
  /// Upper bound of the eigenvalues of D^-1 A: by the power method, at least 2.
  double largest_ = 2;
  Field step_, rest_;
};

}  // namespace hyperlattice::numerics
