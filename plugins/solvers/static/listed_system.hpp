// A listed lattice: the tangent assembled, in blocks of a particle and a neighbour each. What
// solves with it roughly is a class above this one.
#pragma once

#include "spring_tangent.hpp"
#include "system.hpp"

namespace hyperlattice::statics {

class ListedSystem : public System {
 public:
  explicit ListedSystem(const StaticProblem& problem);

  double linearise(const Field& displacement, Field& force) override;
  void multiply(const double* x, double* y) const override;
  void mask(double* x) const override;
  double stiffest() const override;
  int most_iterations() const override { return 20000; }
  void for_springs(const Join& join) const override;

  const StaticGrid& grid() const { return grid_; }
  std::size_t blocks() const {
    return column_.size();
  }  ///< of the tangent, a particle's own among them
  double largest_pull() const {
    return components_ == 4 ? largest_magnitude(pull_) : 0;
  }  ///< N/m, of base springs where heights can move
  double softest_height() const override;
  /// Whether a number of a field can move and has stiffness.
  bool is_unknown(std::size_t number) const;
  /// Calls visit(column, value) for the entries of a row of the tangent, N/m; row and columns are
  /// numbers of a field. Columns of one component ascend, also those of what cannot move.
  template <class Visit>
  void for_row(std::size_t row, const Visit& visit) const {
    const auto places = static_cast<std::size_t>(grid_.places);
    const std::size_t p = row % places, a = row / places;
    for (std::size_t n = first_[p]; n < first_[p + 1]; ++n)
      for (std::size_t b = 0; b < components_; ++b)
        visit(b * places + static_cast<std::size_t>(column_[n]), block(n)[a * components_ + b]);
  }

 private:
  void find_pattern();
  SpringNumbers numbers_of(std::size_t spring) const;
  void assemble(const Field& displacement);
  double* block(std::size_t at) { return blocks_.data() + at * block_size_; }
  const double* block(std::size_t at) const { return blocks_.data() + at * block_size_; }
  std::size_t find(std::int64_t row, std::int64_t column) const;

  const StaticGrid& grid_;
  std::size_t components_, block_size_;
  std::vector<std::size_t>
      first_;  ///< of each particle, where its blocks begin; one more entry at the end
  std::vector<std::int64_t>
      column_;    ///< of each block, ascending in a row; a particle's own among them
  Field blocks_;  ///< row by row, N/m
  Floats axial_, pull_, cross_axial_, cross_pull_, alpha_;
};

}  // namespace hyperlattice::statics
