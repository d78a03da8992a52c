// The likeliest cause of a run that fails, found from its springs as they are then.
#pragma once

#include <model/model.hpp>
#include <state/simulation.hpp>

#include <string>

namespace hyperlattice {

/// What springs say about the present state.
struct SpringExtremes {
  /// A spring that is an extreme, by its value.
  struct Extreme {
    double value = 0;
    Particle a = 0, b = 0;
  };
  Extreme longest{1}, shortest{1};  ///< length over rest length
  /// Largest shortening in a step over the length: 1 means that the ends meet within the step.
  Extreme closing;
  /// Estimate of the critical time step over that of the body at rest: springs that stiffen or are
  /// stretched shorten it.
  double critical = 1;
  Particle stiffest = 0;  ///< the particle that dictates it
};

/// Reads all springs. `time_step`: of the last step, s.
SpringExtremes spring_extremes(const Model& model, const Simulation& simulation, double time_step);

/// Returns one or two sentences: the likeliest cause, and what to change; empty if the springs show
/// nothing unusual. `critical`: critical time step at rest, s.
std::string likely_cause(const Model& model, const SpringExtremes& state, double time_step,
                         double critical);

}  // namespace hyperlattice
