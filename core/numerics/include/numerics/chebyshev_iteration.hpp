// The steps of a Chebyshev iteration on A x = b. It damps equally all eigenvalues of D^-1 A from
// the largest down to a fixed fraction of it (Saad 2003, algorithm 12.1):
//   d <- keep d + take D^-1 (b - A x),   x <- x + d.
#pragma once

namespace hyperlattice::numerics {

class ChebyshevIteration {
 public:
  /// `largest`: upper bound of the eigenvalues of D^-1 A; above 0. Never throws.
  explicit ChebyshevIteration(double largest)
      : degree_(largest <= wide       ? 2
                : largest <= 2 * wide ? 3
                                      : 4),
        middle_(largest * (1 + 1 / share(largest)) / 2),
        half_(largest * (1 - 1 / share(largest)) / 2),
        rho_(half_ / middle_) {}

  /// Number of steps of a smoother. A body that is nearly incompressible has a larger largest
  /// eigenvalue, that of its changes of volume. The others stay where they are, so a smoother for
  /// them has to damp a wider range.
  int degree() const { return degree_; }

  /// The weights of a step: of the previous step d, and of the preconditioned residual D^-1 (b - A
  /// x).
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
  /// Sums of positive terms between two nodes have eigenvalues up to 2, estimates are a little
  /// above it.
  static constexpr double wide = 3;
  static double share(double largest) { return largest <= wide ? 8 : 16; }
  int degree_;
  double middle_, half_, rho_;
};

}  // namespace hyperlattice::numerics
