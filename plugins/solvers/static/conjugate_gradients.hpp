// Conjugate gradients for K x = b with K the tangents of the finest level, an iteration at a time: the caller looks between them.
#pragma once

#include "multigrid.hpp"

namespace hyperlattice::statics {

class ConjugateGradients {
 public:
  ConjugateGradients(const SpringLevel& matrix, Multigrid& preconditioner)
      : matrix_(matrix), preconditioner_(preconditioner), size_(matrix.layout().numbers()) {
    for (Field* field : {&x_, &r_, &z_, &p_, &q_}) field->assign(size_, 0);
  }

  void start(const Field& b);
  /// One iteration. False: K is not positive along direction(), and x() stays.
  bool advance();

  const Field& x() const { return x_; }
  const Field& residual() const { return r_; }
  const Field& direction() const { return p_; }

 private:
  const SpringLevel& matrix_;
  Multigrid& preconditioner_;
  std::size_t size_;
  Field x_, r_, z_, p_, q_;
  double rz_ = 0, last_step_ = 0;
  bool first_ = true;
};

}  // namespace hyperlattice::statics
