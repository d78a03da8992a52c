// A smoother of A x = b: Chebyshev polynomials of D^-1 A, D the block diagonal of A (Adams et al.
// 2003), and the bound of the largest eigenvalue that they need.
#pragma once

#include <numerics/block_jacobi.hpp>
#include <numerics/linear_operator.hpp>

namespace hyperlattice::numerics {

class ChebyshevSmoother {
 public:
  /// A must outlive this and stay as it is.
  ChebyshevSmoother(const LinearOperator& A, BlockJacobi diagonal);

  /// x comes nearer to the solution of A x = b; from_zero: x is 0, whatever it holds.
  void smooth(const Field& b, Field& x, bool from_zero);

  const BlockJacobi& diagonal() const { return diagonal_; }
  /// For the levels below.
  NodeBlocks blocks() const {
    return {
        diagonal_.components(), {diagonal_.inverse().begin(), diagonal_.inverse().end()}, largest_};
  }

 private:
  void estimate_largest();

  const LinearOperator& A_;
  BlockJacobi diagonal_;
  double largest_ = 2;  ///< eigenvalue of D^-1 A, or more: by the power method, and not below 2
  Field step_, rest_;
};

}  // namespace hyperlattice::numerics
