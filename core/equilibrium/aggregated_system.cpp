#include <equilibrium/aggregated_system.hpp>
#include <equilibrium/height_change.hpp>
#include <equilibrium/made_from.hpp>

namespace hyperlattice::equilibrium {

AggregatedSystem::AggregatedSystem(const StaticProblem& problem)
    : ListedSystem(problem), rest_(numbers(), 0) {
  right_.setZero(static_cast<Eigen::Index>(numbers()));
  left_ = right_;
}

double AggregatedSystem::linearise(const Field& displacement, Field& force) {
  present_ = displacement;
  return ListedSystem::linearise(displacement, force);
}

/// Returns whether the levels still serve: since made_at_, no spring was strained or turned by more
/// than 0.02, and the stiffness of the heights has not changed much.
bool AggregatedSystem::is_near(const Field& displacement) const {
  if (holds_heights_otherwise(largest_pull() + pull_made_at_, softest_height())) return false;
  if (holds_numbers_otherwise(own_made_at_, largest_own())) return false;
  constexpr double little = 0.02;
  const auto places = static_cast<std::size_t>(grid().places);
  for (const StaticSpring& spring : grid().springs) {
    double square = 0;
    for (std::size_t c = 0; c < static_cast<std::size_t>(grid().components); ++c) {
      const std::size_t a = c * places + static_cast<std::size_t>(spring.a),
                        b = c * places + static_cast<std::size_t>(spring.b);
      const double apart = (displacement[b] - made_at_[b]) - (displacement[a] - made_at_[a]);
      square += apart * apart;
    }
    if (!(square <= little * little * dot(spring.rest, spring.rest))) return false;
  }
  return true;
}

void AggregatedSystem::prepare() {
  smoother_.emplace(*this, own_blocks());
  if (!made_at_.empty() && is_near(present_)) return;
  make_levels();
  MadeFromWriter write(made_from_);
  for_tangents(write);
  write(made_at_);
}

void AggregatedSystem::make_again(std::span<const double> from) {
  if (from.empty()) return;  // none was made
  MadeFromReader read(from);
  for_tangents(read);
  present_.resize(numbers());
  read(present_);
  assemble(present_);
  smoother_.emplace(*this, own_blocks());
  make_levels();
  made_from_.assign(from.begin(), from.end());
}

/// Makes the coarser levels from the present tangent.
void AggregatedSystem::make_levels() {
  below_.reset();
  below_.emplace(rows(), smoother_->blocks());
  made_at_ = present_;
  pull_made_at_ = largest_pull();
  own_made_at_ = largest_own();
}

numerics::BlockJacobi AggregatedSystem::own_blocks() const {
  const auto places = static_cast<std::size_t>(grid().places),
             components = static_cast<std::size_t>(grid().components);
  return {places, components, threads(), [&](std::size_t p) {
            numerics::BlockJacobi::Block own;
            for (std::size_t a = 0; a < components; ++a)
              own.unknown[a] = is_unknown(a * places + p);
            for (std::size_t a = 0; a < components; ++a)
              if (own.unknown[a])
                for_row(a * places + p, [&](std::size_t number, double value) {
                  if (number % places == p && own.unknown[number / places])
                    own.matrix(static_cast<Eigen::Index>(a),
                               static_cast<Eigen::Index>(number / places)) = value;
                });
            return own;
          }};
}

/// Returns the tangent by particle and component. Components that are held or have no stiffness
/// have the row 1 on the diagonal, so that all particles have the same number of rows.
numerics::SparseRows AggregatedSystem::rows() const {
  constexpr double shift = 1e-6;  // relative addition to the diagonal, for bodies without supports
  const auto places = static_cast<std::size_t>(grid().places),
             components = static_cast<std::size_t>(grid().components);
  std::vector<bool> unknown(numbers());
  for (std::size_t n = 0; n < numbers(); ++n) unknown[n] = is_unknown(n);
  numerics::SparseRows rows(static_cast<Eigen::Index>(numbers()),
                            static_cast<Eigen::Index>(numbers()));
  rows.reserve(static_cast<Eigen::Index>(blocks() * components * components));
  for (std::size_t p = 0; p < places; ++p)
    for (std::size_t a = 0; a < components; ++a) {
      const std::size_t row = a * places + p;
      const auto at = static_cast<Eigen::Index>(p * components + a);
      rows.startVec(at);
      if (unknown[row])
        for_row(row, [&](std::size_t number, double value) {
          if (!unknown[number]) return;
          if (number % places == p) value += smoother_->diagonal().added(row, number);
          if (value == 0) return;
          rows.insertBack(
              at, static_cast<Eigen::Index>(number % places * components + number / places)) =
              number == row ? value * (1 + shift) : value;
        });
      else
        rows.insertBack(at, at) = 1;
    }
  rows.finalize();
  return rows;
}

void AggregatedSystem::apply(const Field& r, Field& z) {
  smoother_->smooth(r, z, true);
  multiply(z.data(), rest_.data());
  const auto places = static_cast<std::size_t>(grid().places),
             components = static_cast<std::size_t>(grid().components);
  const auto for_numbers = [&](const auto& visit) {
    for (std::size_t p = 0; p < places; ++p)
      for (std::size_t c = 0; c < components; ++c)
        visit(c * places + p, static_cast<Eigen::Index>(p * components + c));
  };
  for_numbers(
      [&](std::size_t number, Eigen::Index row) { right_[row] = r[number] - rest_[number]; });
  below_->apply(right_, left_);
  for_numbers([&](std::size_t number, Eigen::Index row) { z[number] += left_[row]; });
  mask(z.data());
  smoother_->smooth(r, z, false);
}

}  // namespace hyperlattice::equilibrium
