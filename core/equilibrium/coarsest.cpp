#include <equilibrium/coarsest.hpp>

#include <numerics/sparse_cholesky.hpp>

namespace hyperlattice::equilibrium {

struct Coarsest::Factor {
  std::vector<std::size_t> numbers;  ///< the components of a field that have stiffness
  numerics::SparseCholesky of;
};

Coarsest::Coarsest(const StencilLevel& level) : factor_(std::make_unique<Factor>()) {
  const GridLayout& layout = level.layout();
  std::vector<int> row_of(layout.numbers(), -1);
  for (std::int64_t p = 0; p < layout.places; ++p)
    for (std::size_t c = 0; c < 4; ++c)
      if (level.block(p, 0)[5 * c] > 0) {
        row_of[4 * static_cast<std::size_t>(p) + c] = static_cast<int>(factor_->numbers.size());
        factor_->numbers.push_back(4 * static_cast<std::size_t>(p) + c);
      }
  std::vector<Eigen::Triplet<double>> entries;
  for (std::int64_t p = 0; p < layout.places; ++p)
    for (std::size_t n = 0; n < level.stride(); ++n) {
      const std::int64_t other = n == 0 ? p : p + level.steps()[n - 1];
      if (other >= layout.places) continue;
      const double* block = level.block(p, n);
      for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = 0; b < 4; ++b) {
          const int row = row_of[4 * static_cast<std::size_t>(p) + a],
                    column = row_of[4 * static_cast<std::size_t>(other) + b];
          if (row < 0 || column < 0 || block[4 * a + b] == 0 || (n == 0 && row < column)) continue;
          entries.emplace_back(std::max(row, column), std::min(row, column), block[4 * a + b]);
        }
    }
  const auto size = static_cast<Eigen::Index>(factor_->numbers.size());
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  constexpr double shift = 1e-6;  // K may be singular: interpolation has more freedom than the body
  factor_->of.compute(matrix, shift);
}

Coarsest::~Coarsest() = default;

void Coarsest::solve(const double* b, double* x) const {
  Eigen::VectorXd right(static_cast<Eigen::Index>(factor_->numbers.size()));
  for (std::size_t n = 0; n < factor_->numbers.size(); ++n)
    right[static_cast<Eigen::Index>(n)] = b[factor_->numbers[n]];
  const Eigen::VectorXd left = factor_->of.solve(right);
  for (std::size_t n = 0; n < factor_->numbers.size(); ++n)
    x[factor_->numbers[n]] = left[static_cast<Eigen::Index>(n)];
}

}  // namespace hyperlattice::equilibrium
