// The way from the loads of a stage's start to those of its end, in steps from one state of rest to
// the next: of the load, or of an opening that controls the load. A step is cut where no state of
// rest is found and where it goes too far beyond the first failure of a spring.
#pragma once

#include "cracking.hpp"
#include "opening_control.hpp"

#include <span>

namespace hyperlattice::equilibrium {

/// Steps are fractions of the load; with an opening, m.
struct LoadStepOptions {
  double longest = 1, shortest = 1;
  double damage_step = 0.05;  ///< largest growth of damage in a step of the longest length
  double overshoot =
      infinity;            ///< of the first failure of a spring, relative; infinite: none breaks
  bool snap_back = false;  ///< whether loads fall where cracks would run on
  std::optional<Opening::Ends> opening{};  ///< what controls the load; none: the load itself
  double opening_end = infinity;           ///< where the stage ends, at the latest, m
};

class LoadSteps {
 public:
  LoadSteps(const StaticProblem& problem, const SolverHost& host, Newton& newton,
            const LoadStepOptions& options);

  /// Goes to the end. Returns false if the run must stop or no further state of rest was found.
  bool run();
  /// Goes on with what the run that is resumed kept last, before run(). Throws std::runtime_error
  /// if it is of another solver or body.
  void recall(std::span<const double> kept);
  /// Returns the outcome of the last search.
  const Outcome& outcome() const { return found_; }
  /// Returns the fraction of the load of the last state of rest.
  double share() const { return share_; }

 private:
  bool is_done() const;
  double place() const { return control_ ? opening_ : share_; }
  bool advance();
  bool accept(bool settles);
  bool complete();
  bool settle();
  bool search(double next, double& reached);
  void go_back();

  const StaticProblem& problem_;
  const SolverHost& host_;
  Newton& newton_;
  LoadStepOptions options_;
  Cracking cracking_;
  std::optional<OpeningControl> control_;
  bool resumed_ = false;   ///< whether the last accepted step is to be completed
  bool was_shown_ = true;  ///< whether that state is one that outputs see before it is complete
  Field u_;                ///< displacements, m
  double share_ = 0;       ///< fraction of the load of the last state of rest
  double opening_ = 0;     ///< of the last state of rest, m
  double length_;          ///< of the next step
  Outcome found_;
};

}  // namespace hyperlattice::equilibrium
