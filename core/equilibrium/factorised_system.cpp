#include <equilibrium/factorised_system.hpp>

#include <numerics/incomplete_cholesky.hpp>
#include <numerics/sparse_cholesky.hpp>

#include <stdexcept>

namespace hyperlattice::equilibrium {

namespace {

using Matrix = Eigen::SparseMatrix<double>;

}  // namespace

struct FactorisedSystem::Factors {
  bool whole = true;
  numerics::SparseCholesky ldlt;
  numerics::IncompleteCholesky incomplete;
};

FactorisedSystem::FactorisedSystem(const StaticProblem& problem, bool whole)
    : ListedSystem(problem), factors_(std::make_unique<Factors>()) {
  factors_->whole = whole;
}

FactorisedSystem::~FactorisedSystem() = default;

void FactorisedSystem::prepare() {
  const auto places = static_cast<std::size_t>(grid().places),
             components = static_cast<std::size_t>(grid().components);
  std::vector<int> row_of(numbers(), -1);
  unknowns_.clear();
  for (std::size_t p = 0; p < places; ++p)
    for (std::size_t number = p; number < numbers(); number += places)
      if (is_unknown(number)) {
        row_of[number] = static_cast<int>(unknowns_.size());
        unknowns_.push_back(number);
      }
  const auto size = static_cast<Eigen::Index>(unknowns_.size());
  Matrix lower(size, size);
  lower.reserve(
      static_cast<Eigen::Index>(blocks() * components * components / 2 + unknowns_.size()));
  for (Eigen::Index column = 0; column < size; ++column) {
    lower.startVec(column);
    for_row(unknowns_[static_cast<std::size_t>(column)],
            [&](std::size_t number, double value) {  // K is symmetric: a row serves as column
              const int row = row_of[number];
              if (row >= column) lower.insertBack(row, column) = value;
            });
  }
  lower.finalize();
  constexpr double shift = 1e-9;  // for bodies without supports, whose K is singular
  if (factors_->whole) return factors_->ldlt.compute(lower, shift);
  if (!factors_->incomplete.compute(lower))
    throw std::runtime_error(
        "the tangent has no incomplete factorisation: preconditioner \"multigrid\" or \"whole\" "
        "may do");
}

void FactorisedSystem::apply(const Field& r, Field& z) {
  Eigen::VectorXd right(static_cast<Eigen::Index>(unknowns_.size()));
  for (std::size_t n = 0; n < unknowns_.size(); ++n)
    right[static_cast<Eigen::Index>(n)] = r[unknowns_[n]];
  const Eigen::VectorXd left =
      factors_->whole ? factors_->ldlt.solve(right) : factors_->incomplete.solve(right);
  std::fill(z.begin(), z.end(), 0.0);
  for (std::size_t n = 0; n < unknowns_.size(); ++n)
    z[unknowns_[n]] = left[static_cast<Eigen::Index>(n)];
}

}  // namespace hyperlattice::equilibrium
