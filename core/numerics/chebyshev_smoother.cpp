#include <numerics/chebyshev_iteration.hpp>
#include <numerics/chebyshev_smoother.hpp>
#include <numerics/power_iteration.hpp>
#include <numerics/random_stream.hpp>

namespace hyperlattice::numerics {

ChebyshevSmoother::ChebyshevSmoother(const LinearOperator& A, BlockJacobi diagonal)
    : A_(A), diagonal_(std::move(diagonal)), step_(A.numbers(), 0), rest_(A.numbers(), 0) {
  estimate_largest();
}

/// For a sum of positive terms between two nodes each the eigenvalue is at most 2: the energy of a
/// term is at most twice that of its ends moving alone.
void ChebyshevSmoother::estimate_largest() {
  RandomStream random;
  for (double& value : step_) value = random.next();
  A_.mask(step_.data());
  const auto length = [&] {
    return std::sqrt(product(step_.data(), step_.data(), step_.size(), A_.threads()));
  };
  const auto divide = [&](double by) {
    for (double& value : step_) value /= by;
  };
  const auto apply = [&] {
    A_.multiply(step_.data(), rest_.data());
    diagonal_.for_inverse_times(rest_,
                                [&](std::size_t number, double value) { step_[number] = value; });
  };
  largest_ = std::max(largest_, PowerIteration{}.largest_eigenvalue(length, divide, apply));
}

void ChebyshevSmoother::smooth(const Field& b, Field& x, bool from_zero) {
  ChebyshevIteration chebyshev(largest_);
  for (int n = 0; n < chebyshev.degree(); ++n) {
    const bool zero = n == 0 && from_zero;
    if (!zero) A_.multiply(x.data(), rest_.data());
    in_pieces(b.size(), A_.threads(), [&](std::size_t first, std::size_t last) {
      for (std::size_t m = first; m < last; ++m) rest_[m] = zero ? b[m] : b[m] - rest_[m];
    });
    const ChebyshevIteration::Step weights = n == 0 ? chebyshev.first() : chebyshev.next();
    diagonal_.for_inverse_times(rest_, [&](std::size_t number, double value) {
      step_[number] = (n == 0 ? 0 : weights.keep * step_[number]) + weights.take * value;
      x[number] = (zero ? 0 : x[number]) + step_[number];
    });
  }
}

}  // namespace hyperlattice::numerics
