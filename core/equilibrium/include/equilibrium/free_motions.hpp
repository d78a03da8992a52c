// Rigid motions without resistance. The body consists of pieces: sets of particles that springs
// join. A piece has the free rigid motions under which its held components do not move.
#pragma once

#include <equilibrium/system.hpp>

#include <array>
#include <string>

namespace hyperlattice::equilibrium {

class FreeMotions : public numerics::Deflation {
 public:
  /// Finds the free motions of the body at a displacement, with the springs that have stiffness in
  /// the present tangents. The displacement must outlive this object.
  FreeMotions(const System& system, const Field& displacement);

  /// Projects a field onto the complement of these motions.
  void remove_from(Field& field) const override;
  struct Driven {
    std::string sentence;
    Field motion;
  };
  /// Returns the free motion that the forces drive most; empty if they drive none.
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
  std::vector<Piece> pieces_;  ///< pieces with free motions
};

}  // namespace hyperlattice::equilibrium
