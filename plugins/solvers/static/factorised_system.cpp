#include "factorised_system.hpp"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>

#include <stdexcept>

namespace hyperlattice::statics {

namespace {

using Matrix = Eigen::SparseMatrix<double>;

}  // namespace

struct FactorisedSystem::Factors {
  bool whole = true;
  Eigen::SimplicialLDLT<Matrix> ldlt;
  Eigen::IncompleteCholesky<double> incomplete;
};

FactorisedSystem::FactorisedSystem(const StaticProblem& problem, bool whole) : ListedSystem(problem), factors_(std::make_unique<Factors>()) {
  factors_->whole = whole;
}

FactorisedSystem::~FactorisedSystem() = default;

void FactorisedSystem::prepare() {
  const auto places = static_cast<std::size_t>(grid().places), components = static_cast<std::size_t>(grid().components);
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
  lower.reserve(static_cast<Eigen::Index>(blocks() * components * components / 2 + unknowns_.size()));
  constexpr double shift = 1e-9;  // where nothing holds the body
  for (Eigen::Index column = 0; column < size; ++column) {
    lower.startVec(column);
    for_row(unknowns_[static_cast<std::size_t>(column)], [&](std::size_t number, double value) {  // the row is the column: K is symmetric
      const int row = row_of[number];
      if (row >= column) lower.insertBack(row, column) = row == column ? value * (1 + shift) : value;
    });
  }
  lower.finalize();
  if (factors_->whole) {
    factors_->ldlt.compute(lower);
    if (factors_->ldlt.info() != Eigen::Success) throw std::runtime_error("the tangent cannot be factorised");
  } else {
    factors_->incomplete.compute(lower);
  }
}

void FactorisedSystem::apply(const Field& r, Field& z) {
  Eigen::VectorXd right(static_cast<Eigen::Index>(unknowns_.size()));
  for (std::size_t n = 0; n < unknowns_.size(); ++n) right[static_cast<Eigen::Index>(n)] = r[unknowns_[n]];
  const Eigen::VectorXd left = factors_->whole ? Eigen::VectorXd(factors_->ldlt.solve(right)) : Eigen::VectorXd(factors_->incomplete.solve(right));
  std::fill(z.begin(), z.end(), 0.0);
  for (std::size_t n = 0; n < unknowns_.size(); ++n) z[unknowns_[n]] = left[static_cast<Eigen::Index>(n)];
}

}  // namespace hyperlattice::statics
