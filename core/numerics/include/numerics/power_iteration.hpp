// The largest eigenvalue of an operator A in absolute value, by the power method (Golub and Van
// Loan 2013, section 7.3.1).
#pragma once

namespace hyperlattice::numerics {

struct PowerIteration {
  int rounds = 12;
  double safety = 1.1;  ///< the estimates approach the largest from below

  /// Returns safety |A x| / |x| after all rounds, in A's unit; 0 if x becomes zero, NaN if x has
  /// one. length(): |x|; divide(by): x /= by; apply(): x = A x. Never throws.
  template <class Length, class Divide, class Apply>
  double largest_eigenvalue(const Length& length, const Divide& divide, const Apply& apply) const {
    for (int n = 0; n < rounds; ++n) {
      const double before = length();
      if (!(before > 0)) return safety * before;
      divide(before);
      apply();
    }
    return safety * length();
  }
};

}  // namespace hyperlattice::numerics
