// The inverse of a node's own block of a matrix, for smoothers: by its eigenvalues, of which the
// least are raised.
#pragma once

#include <Eigen/Core>

namespace hyperlattice::numerics {

/// A block of 4 x 4, N/m: three numbers in space and a height. With block = Q Lambda Q^T the
/// inverse is Q max(Lambda, s lambda_max)^-1 Q^T, s a thousandth: a particle that hangs on two
/// springs has no stiffness in a direction, or a negative one if these are compressed. Heights may
/// be a billion times as stiff as space, or as soft, so they are measured in their own unit.
struct BlockInverse {
  Eigen::Matrix4d inverse = Eigen::Matrix4d::Zero();  ///< zero if the block has no stiffness at all
  Eigen::Matrix4d added = Eigen::Matrix4d::Zero();    ///< what makes the block so stiff, N/m

  /// Rows and columns that are not used, or cannot move, are zero. Of numbers that are not finite,
  /// the inverse is that of the diagonal, where it is finite: no errors.
  explicit BlockInverse(const Eigen::Matrix4d& block);
};

/// The unit of heights in which the stiffness of a block's height, its last number, is as large as
/// the largest in space.
double unit_of_height(double in_space, double of_height);

}  // namespace hyperlattice::numerics
