// The inverse of a node's diagonal block of a matrix, for smoothers: by eigenvalues, with the
// smallest raised.
#pragma once

#include <Eigen/Core>

namespace hyperlattice::numerics {

/// A block of 4 x 4, N/m: three numbers in space and a height. With block = Q Lambda Q^T the
/// inverse is Q max(Lambda, s lambda_max)^-1 Q^T, s = 1/1000. Reason: a particle with only two
/// springs has no stiffness in one direction, or a negative one if they are compressed. Heights may
/// be a billion times as stiff as space, or as soft, so they have their own unit.
struct BlockInverse {
  Eigen::Matrix4d inverse = Eigen::Matrix4d::Zero();  ///< zero if the block has no stiffness at all
  /// Matrix that raises the eigenvalues of the block, N/m.
  Eigen::Matrix4d added = Eigen::Matrix4d::Zero();

  /// `block`: rows and columns that are not used, or cannot move, are zero. Never throws: if
  /// numbers are not finite, the inverse is that of the diagonal, where it is finite.
  explicit BlockInverse(const Eigen::Matrix4d& block);
};

/// Returns the unit of heights that makes the stiffness of a block's height, its last number, equal
/// to the largest stiffness in space.
double unit_of_height(double in_space, double of_height);

}  // namespace hyperlattice::numerics
