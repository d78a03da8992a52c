// A cut that can close, with friction. The springs that the cut took away act while it is closed,
// as if they had never been cut, but from a place that slips.
//
// The faces part and slip in patches; each has a jump g, with a part in the plane of the surface
// and an opening along its normal. A spring from a to b belongs to the patches around its crossing
// by weights w whose sum is 1. With the vector r from a to b, less g, and the rest length L, its
// force in a patch is
//   f = w k (|r| - L) r / |r|        and the patch's traction times its area is  T = sum f.
// If T pulls without an opening, the patch opens until T = 0. Else it is closed, and slips until
// |T_t| <= mu |T_n|.
#pragma once

#include <hyperlattice/load.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace hyperlattice::friction {

/// A symmetric matrix: xx yy zz yz xz xy.
using Symmetric = std::array<double, 6>;

/// One patch of the surface, and its part of springs.
struct Patch {
  Vec3 normal;                      ///< from the side of the springs' first ends to the other one
  Symmetric stiffness;              ///< of the traction times area by an even jump, N/m
  Symmetric compliance;             ///< its inverse, m/N
  std::size_t first = 0, last = 0;  ///< its pieces: first <= n < last
};

class ClosedCut {
 public:
  /// How many numbers a patch keeps: its jump, m.
  static constexpr std::size_t numbers = 3;

  ClosedCut() = default;
  /// Makes the patches of a surface from the springs that cross it. `first_ends`: the place of end
  /// a of each spring at rest, m. `spacing`: of the lattice, m. `friction`: coefficient mu.
  ClosedCut(std::vector<SeveredSpring> springs, std::span<const Vec3> first_ends, double spacing,
            double friction);

  /// The ends of springs, ascending.
  std::span<const Particle> particles() const { return particles_; }
  std::size_t patches() const { return patches_.size(); }
  /// Finds the forces for displacements of particles(), m, and the jumps of before.
  void find(std::span<const Vec3> displacement, std::span<const double> jumps);
  /// Returns the force on the n-th of particles(), N.
  Vec3 force(std::size_t n) const;
  /// Returns the jumps after the last find().
  std::span<const double> jumps() const { return jumps_; }

 private:
  /// The part of a spring that belongs to a patch.
  struct Piece {
    std::uint32_t spring = 0;
    double stiffness = 0;  ///< w k, N/m
  };
  struct Ends {
    std::uint32_t a = 0, b = 0;  ///< numbers among particles()
  };
  void make_patches(std::span<const Vec3> first_ends, double reach);
  Vec3 pull(const Piece& piece, Vec3 jump) const;
  Vec3 traction(const Patch& patch, Vec3 jump);
  /// Returns the jump after the patch has given way, and sets the forces of its pieces.
  Vec3 settle(const Patch& patch, Vec3 jump);
  Vec3 part(const Patch& patch, Vec3 jump);

  double friction_ = 0, fading_ = 0;  ///< mu; opening without forces, m
  std::vector<SeveredSpring> springs_;
  std::vector<Ends> ends_;
  std::vector<Particle> particles_;
  std::vector<Patch> patches_;
  std::vector<Piece> pieces_;
  /// Springs of each particle, in the order of the springs: twice the number, plus 1 for its b.
  std::vector<std::size_t> first_of_;
  std::vector<std::uint32_t> springs_of_;
  std::vector<Vec3> apart_;       ///< u_b - u_a of each spring, m
  std::vector<Vec3> piece_pull_;  ///< of each piece, N
  std::vector<Vec3> pull_;        ///< force of each spring on its end a, N
  std::vector<double> jumps_;
};

}  // namespace hyperlattice::friction
