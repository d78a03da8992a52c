// Preconditioned conjugate gradients for A x = b, A symmetric; the caller runs single iterations.
// The flexible kind (Golub and Ye 1999, Notay 2000), beta = z . (r - r_before) / (z_before .
// r_before), at least 0, because preconditioners differ a little from one call to the next.
#pragma once

#include <numerics/linear_operator.hpp>

namespace hyperlattice::numerics {

class ConjugateGradients {
 public:
  /// Both must outlive this object.
  ConjugateGradients(const LinearOperator& A, Preconditioner& preconditioner)
      : A_(A), preconditioner_(preconditioner), size_(A.numbers()) {
    for (Field* field : {&x_, &r_, &z_, &p_, &q_}) field->assign(size_, 0);
  }

  /// Starts from x = 0. `without`: a subspace that x must be orthogonal to; null: none. It must
  /// outlive the iterations.
  void start(const Field& b, const Deflation* without = nullptr);
  /// Makes one iteration. Returns false if A is not positive along direction(), and x() stays, or
  /// if the preconditioner failed.
  bool advance();
  /// Returns whether the preconditioner gave a direction with finite numbers.
  bool is_sound() const { return sound_; }

  /// Returns the unit of x() and residual(): a power of two that keeps squares of the smallest and
  /// largest b finite.
  double unit() const { return unit_; }
  const Field& x() const { return x_; }
  const Field& residual() const { return r_; }
  const Field& direction() const { return p_; }
  double curvature() const { return curvature_; }  ///< p . A p along direction()

 private:
  const LinearOperator& A_;
  Preconditioner& preconditioner_;
  std::size_t size_;
  const Deflation* without_ = nullptr;
  Field x_, r_, z_, p_, q_;
  double unit_ = 1, rz_ = 0, last_step_ = 0, curvature_ = 0;
  bool first_ = true, sound_ = true;
};

}  // namespace hyperlattice::numerics
