// A piece of the body as a set of point masses: its mass and motion as a whole.
#pragma once

#include <hyperlattice/plain.hpp>

#include <cstdint>

namespace hyperlattice {

class Piece {
 public:
  /// The first pass over the particles: masses, places and velocities.
  void add(double mass, double volume, double kinetic, Vec3 place, Vec3 velocity) {
    ++particles_;
    mass_ += mass;
    volume_ += volume;
    kinetic_ += kinetic;
    moment_ += mass * place;
    momentum_ += mass * velocity;
  }
  /// The second pass, about the centre of mass.
  void add_rotation(double mass, Vec3 place, Vec3 velocity);

  std::uint64_t particles() const { return particles_; }
  double mass() const { return mass_; }        ///< kg
  double kinetic() const { return kinetic_; }  ///< J
  double volume() const { return volume_; }    ///< at rest, m3
  /// Returns the diameter of the ball of this volume, m.
  double size() const;
  Vec3 centre() const { return moment_ / mass_; }      ///< of mass, m
  Vec3 velocity() const { return momentum_ / mass_; }  ///< of the centre of mass, m/s
  /// Returns the angular velocity, rad/s, of a rigid body with the same angular momentum about the
  /// centre of mass; 0 if the particles lie on a line.
  Vec3 spin() const;

 private:
  std::uint64_t particles_ = 0;
  double mass_ = 0, volume_ = 0, kinetic_ = 0;
  Vec3 moment_, momentum_, angular_momentum_;
  Vec3 inertia_[3];  ///< rows of the tensor about the centre of mass, kg m2
};

}  // namespace hyperlattice
