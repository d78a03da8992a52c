// Conjugate gradients for K x = b, an iteration at a time: the caller looks between them.
#pragma once

#include "system.hpp"

namespace hyperlattice::statics {

class FreeMotions;

class ConjugateGradients {
 public:
  explicit ConjugateGradients(System& system) : system_(system), size_(system.numbers()) {
    for (Field* field : {&x_, &r_, &z_, &p_, &q_}) field->assign(size_, 0);
  }

  /// `without`: motions in which x shall have no part; null: none. They must outlive the iterations.
  void start(const Field& b, const FreeMotions* without = nullptr);
  /// One iteration. False: K is not positive along direction(), and x() stays; or the preconditioner is of no use.
  bool advance();
  bool is_sound() const { return sound_; }  ///< the preconditioner gave a direction, of finite numbers

  double unit() const { return unit_; }  ///< of x() and residual(): a power of two that keeps squares of the smallest and largest forces finite
  const Field& x() const { return x_; }
  const Field& residual() const { return r_; }
  const Field& direction() const { return p_; }
  double curvature() const { return curvature_; }  ///< of K along direction(), N/m times its square

 private:
  System& system_;
  std::size_t size_;
  const FreeMotions* without_ = nullptr;
  Field x_, r_, z_, p_, q_;
  double unit_ = 1, rz_ = 0, last_step_ = 0, curvature_ = 0;
  bool first_ = true, sound_ = true;
};

}  // namespace hyperlattice::statics
