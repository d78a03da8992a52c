// States of rest at a given opening: the load is what the opening needs. It falls where a crack
// grows or springs break, also where loads that are held, or held displacements of loaded
// particles, would let the crack run on.
//
// With springs and damage held, the opening grows with the load, and the load is found by secants.
// Damage at rest under the stress that this load gives, and the load that the opening needs with
// this damage, follow each other until neither changes.
#pragma once

#include "opening.hpp"

#include <equilibrium/newton.hpp>

namespace hyperlattice::equilibrium {

class OpeningControl {
 public:
  /// The present state is that of the problem.
  OpeningControl(const StaticProblem& problem, Newton& newton, const Opening::Ends& ends);

  /// Changes the displacements from those of the accepted state of rest, at the fraction `share` of
  /// the load, to those at rest with the opening `wanted`, m, and `share` to its fraction. Where
  /// the whole load opens less, the result is the state under the whole load. `step`: growth of
  /// the opening from one state to the next, m, of which the opening has an error of a thousandth.
  Outcome solve(double wanted, double step, double& share, Field& displacement);
  /// Returns the opening of the state that was found last, or of the stage's start, m.
  double reached() const { return reached_; }
  double start() const { return start_; }  ///< the opening of the stage's start, m
  /// Goes on with these two, m.
  void recall(double start, double reached) {
    start_ = start;
    reached_ = reached;
  }

 private:
  struct Point {
    double share = 0, opening = 0;
  };
  Outcome rest_at(double& share, bool precise, Field& displacement);
  double next_share(const Point& now, const Point* before, double wanted) const;

  const StaticProblem& problem_;
  Newton& newton_;
  Opening opening_;
  double start_, reached_;  // m
};

}  // namespace hyperlattice::equilibrium
