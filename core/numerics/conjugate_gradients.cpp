#include <numerics/conjugate_gradients.hpp>

namespace hyperlattice::numerics {

void ConjugateGradients::start(const Field& b, const Deflation* without) {
  without_ = without;
  std::fill(x_.begin(), x_.end(), 0.0);
  r_ = b;
  unit_ = power_of_two(largest(b));
  for (double& value : r_) value /= unit_;
  if (without_ != nullptr) without_->remove_from(r_);
  first_ = true;
}

bool ConjugateGradients::advance() {
  const int threads = A_.threads();
  preconditioner_.apply(r_, z_);
  if (without_ != nullptr) without_->remove_from(z_);
  // beta uses the change of r instead of r: round-off in the preconditioner then does not spoil the
  // directions.
  const double rz = product(r_.data(), z_.data(), size_, threads);
  const double changed = first_ ? 0 : -last_step_ * product(q_.data(), z_.data(), size_, threads);
  const double beta = first_ ? 0 : std::max(0.0, changed / rz_);
  in_pieces(size_, threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t n = first; n < last; ++n) p_[n] = z_[n] + (beta > 0 ? beta * p_[n] : 0.0);
  });
  first_ = false;
  rz_ = rz;
  A_.multiply(p_.data(), q_.data());
  if (without_ != nullptr) without_->remove_from(q_);
  curvature_ = product(p_.data(), q_.data(), size_, threads);
  sound_ = std::isfinite(rz) && std::isfinite(curvature_) && rz != 0;
  if (!(curvature_ > 0)) return false;
  last_step_ = product(r_.data(), p_.data(), size_, threads) / curvature_;
  in_pieces(size_, threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t n = first; n < last; ++n) {
      x_[n] += last_step_ * p_[n];
      r_[n] -= last_step_ * q_[n];
    }
  });
  return std::isfinite(last_step_);
}

}  // namespace hyperlattice::numerics
