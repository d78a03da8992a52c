// A smoother that takes the numbers of a particle together: Chebyshev polynomials of the inverse of its own block. Particles on few springs are soft
// in directions that lie askew to the axes; smoothers that take one number after the other hardly see these.
#pragma once

#include "aggregation.hpp"
#include "listed_system.hpp"

namespace hyperlattice::statics {

class BlockSmoother {
 public:
  /// Of the system's present tangent.
  explicit BlockSmoother(const ListedSystem& system);

  /// x comes nearer to the solution of K x = b; from_zero: x is 0, whatever it holds.
  void smooth(const Field& b, Field& x, bool from_zero);

  /// What is added, N/m, to an entry of the tangent between two numbers of one particle, so that the particle's block is nowhere softer than
  /// a share of its largest stiffness: conjugate gradients shall not be led into motions of single particles that hang on two springs.
  double added(std::size_t row, std::size_t column) const {
    return added_[(row % places_ * components_ + row / places_) * components_ + column / places_];
  }

  /// For the levels below.
  NodeBlocks blocks() const { return {components_, {inverse_.begin(), inverse_.end()}, largest_}; }

  /// What is added to the diagonal, over itself, where nothing holds a body.
  static constexpr double shift = 1e-6;

 private:
  void invert_blocks();
  void estimate_largest();
  template <class Use>
  void for_inverse_times(const Field& r, const Use& use) const;

  const ListedSystem& system_;
  std::size_t places_, components_;
  Field inverse_;       ///< of each particle's block, row by row; 0 where nothing can move
  Field added_;         ///< the same for added()
  double largest_ = 2;  ///< eigenvalue of the inverse blocks times K, or more
  Field step_, rest_;
};

}  // namespace hyperlattice::statics
