// The system of a listed lattice: the tangent is assembled, with one block for each pair of a
// particle and a neighbour; with nodal volumes also for each pair of particles around a third one.
// Derived classes add the preconditioner.
#pragma once

#include <equilibrium/spring_tangent.hpp>
#include <equilibrium/system.hpp>
#include <equilibrium/volume_tangents.hpp>

namespace hyperlattice::equilibrium {

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
  /// Returns the number of blocks of the tangent, diagonal blocks included.
  std::size_t blocks() const { return column_.size(); }
  /// Returns the largest |f / L| of a base spring, N/m, or 0 without a free membrane.
  double largest_pull() const { return components_ == 4 ? largest_magnitude(pull_) : 0; }
  double softest_height() const override;
  /// Returns the largest stiffness of a number against its own change, N/m.
  double largest_own() const { return largest_magnitude(own_); }
  /// Returns whether a component (index in a field) is free and has stiffness.
  bool is_unknown(std::size_t number) const;
  /// Calls visit(column, value) for the entries of a row of the tangent, N/m, held columns
  /// included. Row and columns are indices in a field; the columns of one component ascend.
  template <class Visit>
  void for_row(std::size_t row, const Visit& visit) const {
    const auto places = static_cast<std::size_t>(grid_.places);
    const std::size_t p = row % places, a = row / places;
    for (std::size_t n = first_[p]; n < first_[p + 1]; ++n)
      for (std::size_t b = 0; b < components_; ++b)
        visit(b * places + static_cast<std::size_t>(column_[n]), block(n)[a * components_ + b]);
  }

 protected:
  /// Calls visit with each array of tangents, for checkpoints.
  template <class Visit>
  void for_tangents(Visit& visit) {
    for (Floats* const of : {&axial_, &pull_, &cross_axial_, &cross_pull_, &own_}) visit(*of);
    volumes_.for_numbers(visit);
  }
  /// Assembles the tangent at a displacement from the present tangents.
  void assemble(const Field& displacement);

 private:
  void find_pattern();
  SpringNumbers numbers_of(std::size_t spring) const;
  void add_volumes(const Field& displacement);
  double* block(std::size_t at) { return blocks_.data() + at * block_size_; }
  const double* block(std::size_t at) const { return blocks_.data() + at * block_size_; }
  std::size_t find(std::int64_t row, std::int64_t column) const;

  const StaticGrid& grid_;
  std::size_t components_, block_size_;
  std::vector<std::size_t>
      first_;  ///< first block of each particle, and the number of all blocks at the end
  std::vector<std::int64_t>
      column_;    ///< particle of each block's column, ascending in a row, diagonal included
  Field blocks_;  ///< [block][a][b], N/m
  Floats axial_, pull_, cross_axial_, cross_pull_, own_;
  VolumeTangents volumes_;
};

}  // namespace hyperlattice::equilibrium
