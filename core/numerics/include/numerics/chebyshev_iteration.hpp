// The steps of a Chebyshev iteration on A x = b, which damps eigenvalues of D^-1 A from the largest
// down to a share of it, all alike (Saad 2003, algorithm 12.1): d <- keep d + take D^-1 (b - A x),
// x <- x + d.
#pragma once

namespace hyperlattice::numerics {

class ChebyshevIteration {
 public:
  /// largest: eigenvalue of D^-1 A, or more; above 0. No errors.
  explicit ChebyshevIteration(double largest)
      : middle_(largest * (1 + 1 / share) / 2),
        half_(largest * (1 - 1 / share) / 2),
        rho_(half_ / middle_) {}

  static constexpr int degree = 2;  ///< steps of a smoother

  /// A step: keep times the last one, and take times the rest that the inverse blocks see.
  struct Step {
    double keep = 0, take = 0;
  };
  Step first() const { return {0, 1 / middle_}; }
  Step next() {
    const double next = 1 / (2 * middle_ / half_ - rho_);
    const Step step{next * rho_, 2 * next / half_};
    rho_ = next;
    return step;
  }

 private:
  static constexpr double share = 8;
  double middle_, half_, rho_;
};

}  // namespace hyperlattice::numerics
