// Multigrid for a matrix without a grid: smoothed aggregation (Vanek, Mandel and Brezina 1996).
// Strongly connected nodes form an aggregate, which moves as one. One damped Jacobi step smooths
// these motions, P = (1 - omega D^-1 K) P_0; their stiffness P^T K P is the coarser level, whose
// nodes are the aggregates. Aggregates have translations and heights, but no rotations: with
// rotations coarse levels would be four times as large, for few iterations less.
#pragma once

#include <numerics/block_jacobi.hpp>
#include <numerics/sparse_cholesky.hpp>

#include <memory>

namespace hyperlattice::numerics {

using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

class AggregationMultigrid {
 public:
  /// Builds the levels below this matrix. Rows are by node and component, three or four for each
  /// node, the fourth a height. A component that cannot move has a row with only its diagonal.
  /// Throws std::runtime_error if the coarsest level cannot be factorised.
  AggregationMultigrid(const SparseRows& finest, const NodeBlocks& blocks);
  ~AggregationMultigrid();

  /// Computes z = P B P^T r, with B about K_coarse^-1, by one V-cycle of the levels below. Vectors
  /// are by node and component.
  void apply(const Eigen::VectorXd& r, Eigen::VectorXd& z);
  std::size_t levels() const { return levels_.size(); }  ///< number of levels below the finest

 private:
  struct Level;
  void cycle(std::size_t level);

  std::vector<std::unique_ptr<Level>> levels_;
  SparseCholesky coarsest_;
};

}  // namespace hyperlattice::numerics
