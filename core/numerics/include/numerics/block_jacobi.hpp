// The block diagonal D of a matrix and its inverse: what block Jacobi and smoothers above it divide
// by. Nodes on few springs are soft in directions that lie askew to the axes; smoothers that take
// one number after the other hardly see these.
#pragma once

#include <numerics/fields.hpp>

#include <Eigen/Core>

#include <array>
#include <functional>

namespace hyperlattice::numerics {

/// What a smoother knows of a matrix whose rows belong to nodes, `components` in turn each.
struct NodeBlocks {
  std::size_t components = 3;
  std::vector<double> inverse;  ///< of each node's block, row by row; 0 where there is no stiffness
  double largest = 2;           ///< eigenvalue of the inverse blocks times the matrix, or more
};

/// Of fields by component and node, [c * nodes + n], with up to four components. Inverses are those
/// of BlockInverse.
class BlockJacobi {
 public:
  struct Block {
    Eigen::Matrix4d matrix =
        Eigen::Matrix4d::Zero();  ///< 0 in rows and columns that are no unknowns
    std::array<bool, 4> unknown{};
  };
  using BlockOf = std::function<Block(std::size_t node)>;
  /// block_of is called by several threads and does not throw. No errors: see BlockInverse.
  BlockJacobi(std::size_t nodes, std::size_t components, int threads, const BlockOf& block_of);

  /// Calls use(number, value) for D^-1 r, nodes at once.
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
  /// What is added, in the matrix's unit, to an entry between two numbers of one node, so that the
  /// node's block is nowhere softer than a share of its largest stiffness: conjugate gradients
  /// shall not be led into motions of single particles that hang on two springs.
  double added(std::size_t row, std::size_t column) const {
    return added_[(row % nodes_ * components_ + row / nodes_) * components_ + column / nodes_];
  }

  std::size_t components() const { return components_; }
  const Field& inverse() const {
    return inverse_;
  }  ///< of each node's block, row by row; 0 where there is no unknown

 private:
  std::size_t nodes_, components_;
  int threads_;
  Field inverse_;
  Field added_;  ///< the same for added()
};

}  // namespace hyperlattice::numerics
