// States of rest of a body whose cohesive materials are damaged. Displacements at rest with the
// damage held, and damage at rest with the displacements held, follow each other until neither
// changes. The growth of damage controls the load: a step ends at the load at which some particle's
// damage has grown by a given amount, even where the load must fall for that.
#pragma once

#include <equilibrium/newton.hpp>

namespace hyperlattice::equilibrium {

class Cracking {
 public:
  /// `follows`: whether the load may fall. If not, cracks that run on under a load that is held do
  /// so to their next state of rest.
  Cracking(const StaticProblem& problem, Newton& newton, bool follows)
      : problem_(problem), newton_(newton), follows_(follows) {}

  /// Changes the displacements from those of the accepted state of rest, at the fraction `share` of
  /// the load, to those of the next one, and `share` to its fraction: `most_share` at most, less
  /// where damage grows by `most_growth`.
  Outcome solve_load_step(double most_share, double most_growth, double& share,
                          Field& displacement);

  /// Whether damage has ended a step: it controls the steps that follow.
  bool has_cracked() const { return cracked_; }
  void set_cracked(bool cracked) { cracked_ = cracked; }

 private:
  const StaticProblem& problem_;
  Newton& newton_;
  bool follows_;
  bool cracked_ = false;
};

}  // namespace hyperlattice::equilibrium
