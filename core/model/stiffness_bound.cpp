#include <model/critical_step.hpp>
#include <numerics/symmetric_eigen.hpp>

namespace hyperlattice {

void StiffnessBound::add(const NeighbourGeometry& neighbour, int side,
                         const SpringConstants& spring, double membrane_distance,
                         KernelChoice::Membrane membrane) {
  const auto add_square = [this](double stiffness, const std::array<double, 4>& n) {
    for (int row = 0, at = 0; row < 4; ++row)
      for (int column = 0; column <= row; ++column)
        sum_[at++] += std::abs(stiffness) * n[static_cast<std::size_t>(row)] *
                      n[static_cast<std::size_t>(column)];
  };
  const auto [x, y, z] =
      -side * neighbour.rest;  // a particle that moves away from its neighbour lengthens the spring
  const double base = neighbour.rest_length, cross = neighbour.cross_rest_length;
  add_square(spring.stiffness, {x / base, y / base, z / base, 0});
  if (membrane == KernelChoice::Membrane::none) return;
  const double height = membrane == KernelChoice::Membrane::free ? membrane_distance / cross : 0;
  add_square(spring.cross_stiffness, {x / cross, y / cross, z / cross, height});
}

void StiffnessBound::add_alpha(double alpha) { sum_[9] += std::abs(alpha); }

void StiffnessBound::add_part(double stiffness, Vec3 vector) {
  const Vec3 n = vector / norm(vector);
  const double entries[] = {n.x * n.x, n.y * n.x, n.y * n.y, n.z * n.x, n.z * n.y, n.z * n.z};
  for (std::size_t at = 0; at < std::size(entries); ++at) sum_[at] += 0.5 * stiffness * entries[at];
}

double StiffnessBound::value() const {
  Eigen::Matrix4d sum;
  for (int row = 0, at = 0; row < 4; ++row)
    for (int column = 0; column <= row; ++column) sum(row, column) = sum_[at++];
  return 2 * numerics::SymmetricEigen<Eigen::Matrix4d>(sum, Eigen::EigenvaluesOnly)
                 .eigenvalues()(3);  // reads the lower triangle
}

}  // namespace hyperlattice
