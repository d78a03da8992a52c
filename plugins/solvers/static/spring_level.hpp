// The finest level: the tangents of the lattice's own springs, never assembled.
#pragma once

#include "numerics.hpp"
#include "rows.hpp"
#include "signatures.hpp"
#include "spring_tangent.hpp"
#include "tangent_rows.hpp"

#include <hyperlattice/statics.hpp>

namespace hyperlattice::statics {

class SpringLevel : public GridLevel {
 public:
  explicit SpringLevel(const StaticProblem& problem);

  /// Takes the tangents at a displacement; returns the energy stored there, J, and the forces of
  /// the springs.
  double linearise(const Field& displacement, Field& force);

  void multiply(const double* x, double* y) const override;
  void divide(std::size_t first, std::size_t last, const double* r, double* z) const override;
  void mask(double* x) const override;
  double largest_eigenvalue() const override { return largest_eigenvalue_; }

  /// Whether the tangents differ so much from those at the last call of prepared() that what was
  /// prepared must be made anew: a spring has been strained or turned by more than a little since
  /// then, or heights are held otherwise. If false, what was prepared then still serves.
  bool is_new() const { return new_; }
  /// Says that all has been prepared for the present tangents.
  void prepared();

  /// False if there is no spring.
  bool tangent(std::size_t neighbour, std::int64_t place, SpringBlocks& blocks) const;
  bool has_spring(std::size_t neighbour, std::int64_t place) const;
  double stiffest() const;  ///< largest tangent of a spring, N/m
  double softest_height() const {
    return softest_height_;
  }  ///< least stiffness of a height, N/m; infinite where none can move
  float alpha(std::int64_t place) const {
    return alpha_.empty() ? 0 : alpha_[static_cast<std::size_t>(place)];
  }
  const StaticGrid& grid() const { return grid_; }
  Signatures signatures() const;

 private:
  template <class Visit>
  void for_rows(const Visit& visit) const;
  void invert_diagonal();
  float largest_change() const;

  const RowKernels* row_kernels_ = &row_kernels();
  const StaticProblem& problem_;
  const StaticGrid& grid_;
  std::vector<Direction> directions_;  ///< to each neighbour
  TangentRows rows_;
  Floats axial_, pull_, cross_axial_, cross_pull_, alpha_;
  Floats moved_,
      moved_when_prepared_;  ///< displacements in lattice constants, by component and place
  double largest_pull_ = 0,
         pull_when_prepared_ = 0;     ///< N/m, of base springs where heights can move
  double softest_height_ = infinity;  ///< N/m, least stiffness of a height
  bool new_ = true;
  bool deformed_ = false;
  double largest_eigenvalue_ = 2;
  Floats diagonal_;  ///< inverse of the diagonal blocks: 10 (6) numbers of each place, by number
                     ///< and place
  std::vector<std::int64_t> held_;  ///< numbers of a field that belong to particles and cannot move
};

}  // namespace hyperlattice::statics
