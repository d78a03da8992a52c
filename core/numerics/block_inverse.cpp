#include <numerics/block_inverse.hpp>

#include <Eigen/Eigenvalues>

#include <cmath>

namespace hyperlattice::numerics {

double unit_of_height(double in_space, double of_height) {
  return in_space > 0 && of_height > 0 && std::isfinite(in_space / of_height)
             ? std::sqrt(in_space / of_height)
             : 1;
}

BlockInverse::BlockInverse(const Eigen::Matrix4d& block) {
  constexpr double softest = 1e-3;  // smallest stiffness over the largest
  const double height = unit_of_height(block.diagonal().head<3>().maxCoeff(), block(3, 3));
  const Eigen::Vector4d unit{1, 1, 1, height};
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> modes(unit.asDiagonal() * block *
                                                             unit.asDiagonal());
  if (modes.info() != Eigen::Success) {  // numbers are not finite: Newton's method reports them
    inverse.diagonal() = block.diagonal().unaryExpr(
        [](double value) { return value > 0 && std::isfinite(value) ? 1 / value : 0.0; });
    return;
  }
  const double largest = modes.eigenvalues()[3];
  if (!(largest > 0)) return;
  const Eigen::Vector4d flexibility =
      modes.eigenvalues().cwiseMax(softest * largest).cwiseInverse();
  const Eigen::Vector4d more = (softest * largest - modes.eigenvalues().array()).cwiseMax(0.0);
  const Eigen::Matrix4d& turn = modes.eigenvectors();
  inverse =
      unit.asDiagonal() * (turn * flexibility.asDiagonal() * turn.transpose()) * unit.asDiagonal();
  added = unit.cwiseInverse().asDiagonal() * (turn * more.asDiagonal() * turn.transpose()) *
          unit.cwiseInverse().asDiagonal();
}

}  // namespace hyperlattice::numerics
