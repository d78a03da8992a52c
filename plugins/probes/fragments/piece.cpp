#include "piece.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace hyperlattice {

double Piece::size() const { return std::cbrt(6 * volume_ / std::numbers::pi); }

void Piece::add_rotation(double mass, Vec3 place, Vec3 velocity) {
  const Vec3 arm = place - centre();
  angular_momentum_ += mass * cross(arm, velocity - this->velocity());
  for (int row = 0; row < 3; ++row) {
    Vec3 unit;
    unit[row] = 1;
    inertia_[row] += mass * (dot(arm, arm) * unit - arm[row] * arm);
  }
}

/// Solves inertia . spin = angular momentum by the inverse of a symmetric matrix, which the cross
/// products of its rows give.
Vec3 Piece::spin() const {
  const Vec3 first = cross(inertia_[1], inertia_[2]), second = cross(inertia_[2], inertia_[0]),
             third = cross(inertia_[0], inertia_[1]);
  const double determinant = dot(inertia_[0], first),
               trace = inertia_[0].x + inertia_[1].y + inertia_[2].z;
  constexpr double flattest = 1e-9;  // of the inertia about the axis, over the whole
  if (!(determinant > flattest * trace * trace * trace)) return {};
  return 1 / determinant *
         (angular_momentum_.x * first + angular_momentum_.y * second + angular_momentum_.z * third);
}

}  // namespace hyperlattice
