#include "amg_system.hpp"

namespace hyperlattice::statics {

AmgSystem::AmgSystem(const StaticProblem& problem, double strong_threshold) : ListedSystem(problem), strong_threshold_(strong_threshold) {
  for (Field* field : {&rest_, &correction_, &right_, &left_}) field->assign(numbers(), 0);
}

double AmgSystem::linearise(const Field& displacement, Field& force) {
  present_ = displacement;
  return ListedSystem::linearise(displacement, force);
}

/// Whether no spring has been strained or turned much on the way from made_at_.
bool AmgSystem::is_near(const Field& displacement) const {
  constexpr double little = 0.02;
  const auto places = static_cast<std::size_t>(grid().places);
  for (const StaticSpring& spring : grid().springs) {
    double square = 0;
    for (std::size_t c = 0; c < static_cast<std::size_t>(grid().components); ++c) {
      const std::size_t a = c * places + static_cast<std::size_t>(spring.a), b = c * places + static_cast<std::size_t>(spring.b);
      const double apart = (displacement[b] - made_at_[b]) - (displacement[a] - made_at_[a]);
      square += apart * apart;
    }
    if (!(square <= little * little * dot(spring.rest, spring.rest))) return false;
  }
  return true;
}

void AmgSystem::prepare() {
  smoother_.emplace(*this);
  if (!made_at_.empty() && is_near(present_)) return;
  multigrid_.reset();
  multigrid_.emplace(rows(), grid().components, strong_threshold_);
  made_at_ = present_;
}

/// What cannot move, or has no stiffness, has a row of its own; so each particle has as many rows.
SparseRows AmgSystem::rows() const {
  const auto places = static_cast<std::size_t>(grid().places), components = static_cast<std::size_t>(grid().components);
  std::vector<bool> unknown(numbers());
  for (std::size_t n = 0; n < numbers(); ++n) unknown[n] = is_unknown(n);
  SparseRows rows;
  rows.entries.reserve(numbers());
  rows.column.reserve(blocks() * components * components);
  rows.value.reserve(blocks() * components * components);
  const auto add = [&](std::size_t number, double value) {
    rows.column.push_back(static_cast<HYPRE_BigInt>(number % places * components + number / places));
    rows.value.push_back(value);
  };
  for (std::size_t p = 0; p < places; ++p)
    for (std::size_t row = p; row < numbers(); row += places) {
      const std::size_t before = rows.column.size();
      if (unknown[row])
        for_row(row, [&](std::size_t number, double value) {
          if (!unknown[number]) return;
          if (number % places == p) value += smoother_->added(row, number);
          if (value != 0) add(number, number == row ? value * (1 + BlockSmoother::shift) : value);
        });
      else
        add(row, 1);
      rows.entries.push_back(static_cast<HYPRE_Int>(rows.column.size() - before));
    }
  return rows;
}

void AmgSystem::apply(const Field& r, Field& z) {
  smoother_->smooth(r, z, true);
  multiply(z.data(), rest_.data());
  for (std::size_t n = 0; n < rest_.size(); ++n) rest_[n] = r[n] - rest_[n];
  cycle(rest_, correction_);
  for (std::size_t n = 0; n < rest_.size(); ++n) z[n] += correction_[n];
  smoother_->smooth(r, z, false);
}

void AmgSystem::cycle(const Field& r, Field& z) {
  const auto places = static_cast<std::size_t>(grid().places), components = static_cast<std::size_t>(grid().components);
  for (std::size_t p = 0; p < places; ++p)
    for (std::size_t c = 0; c < components; ++c) right_[p * components + c] = r[c * places + p];
  multigrid_->apply(right_, left_);
  for (std::size_t p = 0; p < places; ++p)
    for (std::size_t c = 0; c < components; ++c) z[c * places + p] = left_[p * components + c];
  mask(z.data());
}

}  // namespace hyperlattice::statics
