// The block diagonal D of a matrix and its inverse, for block Jacobi and smoothers built on it.
// Nodes with few springs are soft in directions oblique to the axes; smoothers that treat one
// number after the other hardly reduce errors in these directions.
#pragma once

#include <numerics/fields.hpp>

#include <Eigen/Core>

#include <array>
#include <functional>

namespace hyperlattice::numerics {

/// The data of a smoother for a matrix with `components` rows for each node.
struct NodeBlocks {
  std::size_t components = 3;
  /// Inverse of each node's block, row by row; 0 where there is no stiffness.
  std::vector<double> inverse;
  double largest = 2;  ///< upper bound of the eigenvalues of the inverse blocks times the matrix
};

/// Block Jacobi for fields by component and node, [c * nodes + n], with up to four components.
/// Inverses are those of BlockInverse.
class BlockJacobi {
 public:
  struct Block {
    /// 0 in rows and columns that are not unknowns.
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
    std::array<bool, 4> unknown{};
  };
  using BlockOf = std::function<Block(std::size_t node)>;
  /// Several threads call block_of, which must not throw. Never throws: see BlockInverse.
  BlockJacobi(std::size_t nodes, std::size_t components, int threads, const BlockOf& block_of);

  /// Calls use(number, value) for each number of D^-1 r, several threads at once.
  template <class Use>
  void for_inverse_times(const Field& r, const Use& use) const {
    in_pieces(nodes_, threads_, [&](std::size_t first, std::size_t last) {
      for (std::size_t p = first; p < last; ++p)
        for (std::size_t a = 0; a < components_; ++a) {
          double sum = 0;
          for (std::size_t b = 0; b < components_; ++b)
            sum += inverse_[(p * components_ + a) * components_ + b] * r[b * nodes_ + p];
          use(a * nodes_ + p, sum);
        }
    });
  }
  /// Returns the value, in the matrix's unit, to add to an entry between two numbers of one node,
  /// so that no direction of the node's block is softer than a fraction of its largest stiffness:
  /// conjugate gradients must not follow motions of single particles with only two springs.
  double added(std::size_t row, std::size_t column) const {
    return added_[(row % nodes_ * components_ + row / nodes_) * components_ + column / nodes_];
  }

  std::size_t components() const { return components_; }
  /// Returns the inverse of each node's block, row by row; 0 where there is no unknown.
  const Field& inverse() const { return inverse_; }

 private:
  std::size_t nodes_, components_;
  int threads_;
  Field inverse_;
  Field added_;  ///< added parts of each node's block, row by row
};

}  // namespace hyperlattice::numerics
