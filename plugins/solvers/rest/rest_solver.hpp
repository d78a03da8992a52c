// What solvers that find rest by Newton's method have in common: their options, and the way through the steps of the load.
#pragma once

#include "system.hpp"

#include <hyperlattice/rest.hpp>

#include <optional>

namespace hyperlattice::statics {

/// A solver's Options derive from these.
struct RestOptions {
  double tolerance = 1e-6, load_steps = 1, most_cutbacks = 10;
  std::optional<bool> stability;
  std::optional<double> end_time;
};

/// A literal, to which a solver may add its own.
#define HYPERLATTICE_REST_RESTRICTIONS                                                                                                      \
  "Springs do not break during the stage; those beyond their limit at its end break in the first step in time that "                        \
  "follows. A body that is a mechanism under its loads, or buckles, is an error that says where it moves. Energy is booked along the load " \
  "steps by the trapezoidal rule: with large deformations in few steps the balance of this stage is as rough as that rule."

/// The declaration of a solver with these options.
template <class Options>
Schema<Options> rest_schema(std::string_view name, std::string_view summary) {
  return Schema<Options>(name, summary)
      .source("docs/theory/statics.md")
      .template add<&Options::tolerance>(
          "tolerance", "", "residual at which the body is at rest: largest out-of-balance force over the mean force on held or loaded particles")
      .positive()
      .fallback("1e-6")
      .template add<&Options::load_steps>("load_steps", "",
                                          "equal steps from the loads of the stage's start to those of its end; a step that fails is cut in halves")
      .at_least(1)
      .fallback("1")
      .template add<&Options::most_cutbacks>("most_cutbacks", "", "times that a load step may be halved before the run fails")
      .at_least(0)
      .fallback("10")
      .template add<&Options::stability>(
          "stability", "",
          "whether states of rest must be stable: each that took more than one tangent is searched for a motion along which its "
          "stiffness is negative; left out: of structured lattices, as particles of a list that hang on two springs buckle alone")
      .template add<&Options::end_time>(
          "end_time", "s", "instant whose loads act at the end, from the start of the run; left out: when the last load has stopped changing")
      .at_least(0);
}

/// What a solver with these options will do; std::runtime_error as from plan_of_rest().
SolverPlan plan_of_load_steps(const SolverFacts& facts, const RestOptions& options);

/// From the state of the stage's start to rest under the loads of its end, with the system of host.statics(). std::runtime_error that says why there
/// is none. Returns early if the host asks to stop.
void bring_to_rest(System& system, const SolverFacts& facts, SolverHost& host, const RestOptions& options);

}  // namespace hyperlattice::statics
