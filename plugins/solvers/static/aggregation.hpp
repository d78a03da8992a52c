// Multigrid of a matrix, without a grid: smoothed aggregation (Vanek, Mandel and Brezina 1996). Particles that are strongly joined make an aggregate,
// which moves as one; one damped Jacobi step smooths these motions, and their stiffness P^T K P is the coarser level, where aggregates are the
// particles. Translations and heights alone: with rotations too, coarse levels would be four times as large, for few iterations less.
#pragma once

#include "factorisation.hpp"
#include "fields.hpp"

#include <memory>

namespace hyperlattice::statics {

using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// What a smoother knows of a matrix whose rows belong to nodes, `components` in turn each.
struct NodeBlocks {
  std::size_t components = 3;
  std::vector<double> inverse;  ///< of each node's block, row by row; 0 where there is no stiffness
  double largest = 2;           ///< eigenvalue of the inverse blocks times the matrix, or more
};

class Aggregation {
 public:
  /// The levels below the one of this matrix. What cannot move has a row with nothing but its diagonal.
  Aggregation(const SparseRows& finest, const NodeBlocks& blocks);
  ~Aggregation();

  /// z = P (about K_coarse^-1) P^T r. By node and component.
  void apply(const Eigen::VectorXd& r, Eigen::VectorXd& z);
  std::size_t levels() const { return levels_.size(); }  ///< below the finest

 private:
  struct Level;
  void cycle(std::size_t level);

  std::vector<std::unique_ptr<Level>> levels_;
  Factorisation coarsest_;
};

}  // namespace hyperlattice::statics
