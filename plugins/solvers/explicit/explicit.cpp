// Explicit dynamics by central differences, with velocities at half steps:
//
//   v(n+1/2) = v(n-1/2) + dt F(u(n)) / m        u(n+1) = u(n) + dt v(n+1/2)
//
// The method is stable for dt < dt_c = 2 / omega_max. Cundall's local damping replaces F by
// F - alpha |F| sign(v); the limit is then dt_c / sqrt(1 + alpha). All steps of a stage are equal,
// because a change of the step changes the energy. Loads act by their mean over each step, so that
// no step must end at a corner of a load.
#include <hyperlattice/files.hpp>
#include <hyperlattice/solver.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

namespace hyperlattice {

class Explicit {
 public:
  struct Options {
    double end_time = 0;
    std::optional<double> time_step;
    double safety = 0.9;
    double damping = 0;
    std::optional<std::int64_t> local_steps = 1;
  };

  static Schema<Options> schema() {
    return Schema<Options>("solvers.explicit",
                           "Explicit dynamics by central differences, up to an instant")
        .equation(
            "v(n+1/2) = v(n-1/2) + dt (F - damping |F| sign(v)) / m,  u(n+1) = u(n) + dt v(n+1/2); "
            " dt < dt_c / sqrt(1 + damping)")
        .source(
            "Zhao 2017, section 2.2 (central differences, local damping); limit: 2 / omega_max of "
            "the lattice by Bloch analysis")
        .restrictions(
            "All steps of a stage are equal and the last ends at end_time, so they may be a little "
            "shorter than time_step. Loads act by the mean of "
            "their factor over each step: the impulse is exact whatever the step, if the load "
            "names its kinks and jumps (of loads.expression: "
            "`corners`).")
        .add<&Options::end_time>("end_time", "s",
                                 "instant at which the stage ends, counted from the start of the "
                                 "whole run, not of the stage")
        .example("\"20 us\"")
        .positive()
        .add<&Options::time_step>("time_step", "s",
                                  "longest step; auto: the fraction `safety` of the stable one; a "
                                  "number above the stable step is refused")
        .word("auto")
        .fallback("\"auto\"")
        .positive()
        .add<&Options::safety>("safety", "",
                               "fraction of the stable step that auto takes; 0.8 for large strains")
        .above(0)
        .below(1)
        .fallback("0.9")
        .add<&Options::damping>(
            "damping", "", "local non-viscous damping alpha, towards a static solution; 0: none")
        .at_least(0)
        .below(1)
        .fallback("0")
        .add<&Options::local_steps>(
            "local_steps", "",
            "steps that stiff particles take within one step of the others, which is so many times "
            "longer than the stable step of all, or as long as the others allow; auto: as many as "
            "cost least; 1: all take the same steps")
        .word("auto")
        .at_least(1)
        .at_most(1e6)
        .fallback("1")
        .check([](const Options& o, const FaultSink& faults) {
          if (o.local_steps != 1 && o.damping > 0)
            faults.fault("local_steps", "1 with `damping`: damping acts in whole steps");
        });
  }

  explicit Explicit(const Options& options) : options_(options) {}

  SolverPlan plan(const SolverFacts& facts) const {
    SolverPlan plan;
    plan.end_time = options_.end_time;
    plan.damping = options_.damping;
    plan.resumes = true;
    plan.stable_time_step = facts.critical_time_step / std::sqrt(1 + options_.damping);
    if (options_.local_steps != 1) {
      plan.local = facts.local_steps(options_.local_steps.value_or(0));
      plan.sweeps_per_step = plan.local.cost;
      if (plan.local.parts > 1) plan.stable_time_step = plan.local.time_step;
    }
    const double longest = longest_step(facts, plan.stable_time_step),
                 length = options_.end_time - facts.start_time;
    constexpr double round_off =
        1 - 1e-12;  // keeps a time_step that divides the length of the stage
    const double parts = std::ceil(length / longest * round_off);
    if (!(parts < 1e15))
      throw std::runtime_error(
          "a longer time step or an earlier end: this would take more than 1e15 steps");
    plan.steps = static_cast<std::uint64_t>(std::max(1.0, parts));
    plan.time_step = length / static_cast<double>(plan.steps);
    return plan;
  }

  void run(const SolverFacts& facts, SolverHost& host) const {
    const SolverPlan planned = plan(facts);
    if (host.steps_done == 0 && !host.observe()) return;
    for (std::uint64_t n = host.steps_done; n < planned.steps; ++n)
      if (!host.step(planned.time_step) || !host.observe()) return;
  }

 private:
  double longest_step(const SolverFacts& facts, double stable) const {
    if (!(options_.end_time > facts.start_time))
      throw std::runtime_error(
          "end_time after " + short_number(facts.start_time) +
          " s, where the stage starts: it counts from the start of the whole run");
    const double longest = options_.time_step.value_or(options_.safety * stable);
    if (!(longest <= stable))
      throw std::runtime_error(
          "time_step of at most " + short_number(stable) + " s, the stable limit" +
          (options_.damping > 0 ? " (the critical step " + short_number(facts.critical_time_step) +
                                      " s over sqrt(1 + damping))"
                                : "") +
          "; \"auto\" takes " + short_number(options_.safety * stable) + " s");
    return longest;
  }

  Options options_;
};

}  // namespace hyperlattice

HYPERLATTICE_PLUGIN("1.0") { plugin.add<hyperlattice::Explicit>(); }
