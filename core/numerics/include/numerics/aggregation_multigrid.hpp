// Multigrid of a matrix, without a grid: smoothed aggregation (Vanek, Mandel and Brezina 1996).
// Nodes that are strongly joined make an aggregate, which moves as one; one damped Jacobi step
// smooths these motions, P = (1 - omega D^-1 K) P_0, and their stiffness P^T K P is the coarser
// level, where aggregates are the nodes. Translations and heights alone: with rotations too, coarse
// levels would be four times as large, for few iterations less.
#pragma once

#include <numerics/block_jacobi.hpp>
#include <numerics/sparse_cholesky.hpp>

#include <memory>

namespace hyperlattice::numerics {

using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

class AggregationMultigrid {
 public:
  /// The levels below the one of this matrix, whose rows are by node and component, three or four a
  /// node, the fourth a height. What cannot move has a row with nothing but its diagonal. Throws
  /// std::runtime_error if the coarsest level cannot be factorised.
  AggregationMultigrid(const SparseRows& finest, const NodeBlocks& blocks);
  ~AggregationMultigrid();

  /// z = P (about K_coarse^-1) P^T r, by one V-cycle of the levels below. By node and component.
  void apply(const Eigen::VectorXd& r, Eigen::VectorXd& z);
  std::size_t levels() const { return levels_.size(); }  ///< below the finest

 private:
  struct Level;
  void cycle(std::size_t level);

  std::vector<std::unique_ptr<Level>> levels_;
  SparseCholesky coarsest_;
};

}  // namespace hyperlattice::numerics
