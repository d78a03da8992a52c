#include "block_smoother.hpp"

#include "block_inverse.hpp"
#include "chebyshev.hpp"

namespace hyperlattice::statics {

BlockSmoother::BlockSmoother(const ListedSystem& system)
    : system_(system),
      places_(static_cast<std::size_t>(system.grid().places)),
      components_(static_cast<std::size_t>(system.grid().components)),
      step_(system.numbers(), 0),
      rest_(system.numbers(), 0) {
  invert_blocks();
  estimate_largest();
}

void BlockSmoother::invert_blocks() {
  inverse_.assign(system_.numbers() * components_, 0);
  added_ = inverse_;
  in_pieces(places_, system_.threads(), [&](std::size_t first, std::size_t last) {
    for (std::size_t p = first; p < last; ++p) {
      Eigen::Matrix4d block = Eigen::Matrix4d::Zero();
      for (std::size_t a = 0; a < components_; ++a)
        if (system_.is_unknown(a * places_ + p))
          system_.for_row(a * places_ + p, [&](std::size_t number, double value) {
            if (number % places_ == p && system_.is_unknown(number))
              block(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(number / places_)) = value;
          });
      const BlockInverse own(block);
      for (std::size_t a = 0; a < components_; ++a)
        for (std::size_t b = 0; b < components_; ++b)
          if (system_.is_unknown(a * places_ + p) && system_.is_unknown(b * places_ + p)) {
            const auto row = static_cast<Eigen::Index>(a), column = static_cast<Eigen::Index>(b);
            inverse_[(p * components_ + a) * components_ + b] = own.inverse(row, column);
            added_[(p * components_ + a) * components_ + b] = own.added(row, column);
          }
    }
  });
}

/// Calls use(number, value) for D^-1 r.
template <class Use>
void BlockSmoother::for_inverse_times(const Field& r, const Use& use) const {
  in_pieces(places_, system_.threads(), [&](std::size_t first, std::size_t last) {
    for (std::size_t p = first; p < last; ++p)
      for (std::size_t a = 0; a < components_; ++a) {
        double sum = 0;
        for (std::size_t b = 0; b < components_; ++b) sum += inverse_[(p * components_ + a) * components_ + b] * r[b * places_ + p];
        use(a * places_ + p, sum);
      }
  });
}

/// At most 2 without compressed springs: a spring's energy is at most twice that of its ends moving alone.
void BlockSmoother::estimate_largest() {
  constexpr int rounds = 12;
  constexpr double safe = 1.1;
  std::uint32_t random = 12345;
  for (double& value : step_) {
    random = random * 1664525u + 1013904223u;
    value = static_cast<double>(random >> 8) / 16777216.0 - 0.5;
  }
  system_.mask(step_.data());
  const auto length = [&] { return std::sqrt(product(step_.data(), step_.data(), step_.size(), system_.threads())); };
  for (int n = 0; n < rounds; ++n) {
    const double before = length();
    if (!(before > 0)) return;
    for (double& value : step_) value /= before;
    system_.multiply(step_.data(), rest_.data());
    for_inverse_times(rest_, [&](std::size_t number, double value) { step_[number] = value; });
  }
  largest_ = std::max(largest_, safe * length());
}

void BlockSmoother::smooth(const Field& b, Field& x, bool from_zero) {
  Chebyshev chebyshev(largest_);
  for (int n = 0; n < Chebyshev::degree; ++n) {
    const bool zero = n == 0 && from_zero;
    if (!zero) system_.multiply(x.data(), rest_.data());
    in_pieces(b.size(), system_.threads(), [&](std::size_t first, std::size_t last) {
      for (std::size_t m = first; m < last; ++m) rest_[m] = zero ? b[m] : b[m] - rest_[m];
    });
    const Chebyshev::Step weights = n == 0 ? chebyshev.first() : chebyshev.next();
    for_inverse_times(rest_, [&](std::size_t number, double value) {
      step_[number] = (n == 0 ? 0 : weights.keep * step_[number]) + weights.take * value;
      x[number] = (zero ? 0 : x[number]) + step_[number];
    });
  }
}

}  // namespace hyperlattice::statics
