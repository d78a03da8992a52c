// The finest level of multigrid: the tangents of the lattice's springs and cells, applied without
// assembly.
#pragma once

#include <equilibrium/cell_tangent.hpp>
#include <equilibrium/numerics.hpp>
#include <equilibrium/rows.hpp>
#include <equilibrium/signatures.hpp>
#include <equilibrium/spring_tangent.hpp>
#include <equilibrium/tangent_rows.hpp>

#include <hyperlattice/statics.hpp>

#include <span>

namespace hyperlattice::equilibrium {

class SpringLevel : public GridLevel {
 public:
  explicit SpringLevel(const StaticProblem& problem);

  /// Computes the tangents at a displacement. Returns the stored energy, J, and in `force` the
  /// forces of the springs, N.
  double linearise(const Field& displacement, Field& force);

  void multiply(const double* x, double* y) const override;
  void divide(std::size_t first, std::size_t last, const double* r, double* z) const override;
  void mask(double* x) const override;
  double largest_eigenvalue() const override { return largest_eigenvalue_; }

  /// Returns whether the preconditioner must be made again: since the last call of prepared(), a
  /// spring was strained or turned by more than 0.02, or the stiffness of heights changed much.
  bool is_new() const { return new_; }
  /// Marks the preconditioner as made for the present tangents.
  void prepared();
  /// Returns the tangents for which prepared() was called last, for a checkpoint.
  std::span<const double> made_from() const { return made_from_; }
  /// Takes over the tangents that made_from() returned. Throws std::runtime_error if they are of
  /// another body.
  void recall(std::span<const double> made_from);

  /// Computes the tangent of the spring from a place to a neighbour. Returns false if there is no
  /// spring.
  bool tangent(std::size_t neighbour, std::int64_t place, SpringBlocks& blocks) const;
  /// Computes the tangent of the cell of which a place is the lowest corner. Returns false if there
  /// is no cell.
  bool cell(std::int64_t place, CellTangent& tangent) const;
  bool has_spring(std::size_t neighbour, std::int64_t place) const;
  double stiffest() const;  ///< largest tangent of a spring, N/m
  /// Returns the least stiffness of a height, N/m; infinite if no height can move.
  double softest_height() const { return softest_height_; }
  bool has_own() const { return !own_.empty(); }
  /// Returns the stiffness of a number against its own change, see SpringTangents.
  float own(int component, std::size_t place) const {
    return own_.empty()
               ? 0
               : own_[static_cast<std::size_t>(component) * static_cast<std::size_t>(grid_.places) +
                      place];
  }
  const StaticGrid& grid() const { return grid_; }
  Signatures signatures() const;

 private:
  template <class Visit>
  void for_rows(const Visit& visit) const;
  void add_cells_to_diagonal(std::int64_t first, std::int64_t count);
  void invert_diagonal();
  float largest_change() const;
  SpringTangents tangents();
  template <class Visit>
  void for_made_from(Visit visit);

  const RowKernels* row_kernels_ = &row_kernels();
  const StaticProblem& problem_;
  const StaticGrid& grid_;
  std::vector<Direction> directions_;  ///< one for each neighbour
  TangentRows rows_;
  Floats axial_, pull_, cross_axial_, cross_pull_, own_, cell_stiffness_, cell_pressure_;
  Floats moved_,
      moved_when_prepared_;  ///< displacements in lattice constants, [component][place]
  double largest_pull_ = 0,
         pull_when_prepared_ = 0;     ///< largest |f / L| of base springs, N/m; 0 without heights
  double own_when_prepared_ = 0;      ///< largest stiffness of a number against its own change, N/m
  double softest_height_ = infinity;  ///< N/m, least stiffness of a height
  std::vector<double> made_from_;
  bool new_ = true;
  bool deformed_ = false;
  double largest_eigenvalue_ = 2;
  Floats diagonal_;  ///< inverse diagonal blocks, [number][place]: 10 numbers with heights, else 6
  std::vector<std::int64_t> held_;  ///< indices in a field of held components
};

}  // namespace hyperlattice::equilibrium
