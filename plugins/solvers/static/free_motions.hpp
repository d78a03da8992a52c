// Rigid motions that nothing resists: those of each piece of the body, a set of particles that
// springs join, that leave in place all that is held.
#pragma once

#include "system.hpp"

#include <array>
#include <string>

namespace hyperlattice::statics {

class FreeMotions : public numerics::Deflation {
 public:
  /// Of the body at a displacement, which must outlive this, with the springs that have stiffness
  /// in the present tangents.
  FreeMotions(const System& system, const Field& displacement);

  /// Takes the part of these motions out of a field.
  void remove_from(Field& field) const override;
  struct Driven {
    std::string sentence;
    Field motion;
  };
  /// The free motion that forces drive most; "" and empty if they drive none.
  Driven driven_by(const Field& force) const;

 private:
  using Motion =
      std::array<double, 6>;  ///< translation, and rotation about the piece's centre times its size
  struct Piece {
    std::vector<std::int64_t> places;
    Vec3 centre;                  ///< m
    double size = 0;              ///< m, root of the mean square distance from the centre
    std::vector<Motion> motions;  ///< orthonormal over the particles
  };
  Vec3 position(std::int64_t place) const;
  Vec3 moved(const Piece& piece, const Motion& motion, std::int64_t place) const;
  double along(const Piece& piece, const Motion& motion, const Field& field) const;
  void find_motions(Piece& piece) const;
  std::string sentence(const Piece& piece, const Motion& motion) const;

  const StaticProblem& problem_;
  const Field& displacement_;
  std::uint64_t particles_ = 0;
  std::vector<Piece> pieces_;  ///< that can move
};

}  // namespace hyperlattice::statics
