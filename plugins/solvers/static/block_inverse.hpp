// The inverse of a particle's own block of the tangent, for smoothers.
#pragma once

#include <Eigen/Core>

namespace hyperlattice::statics {

/// A particle that hangs on two springs has no stiffness in a direction, or a negative one if these are compressed. There the block counts as a
/// thousandth of its largest stiffness. Heights may be a billion times as stiff as space, or as soft, so they are measured in their own unit.
struct BlockInverse {
  Eigen::Matrix4d inverse = Eigen::Matrix4d::Zero();  ///< zero if the block has no stiffness at all
  Eigen::Matrix4d added = Eigen::Matrix4d::Zero();    ///< what makes the block so stiff, N/m

  /// Rows and columns that are not used, or cannot move, are zero.
  explicit BlockInverse(const Eigen::Matrix4d& block);
};

/// The unit of heights in which the stiffness of a block's height, its last number, is as large as the largest in space.
double unit_of_height(double in_space, double of_height);

}  // namespace hyperlattice::statics
