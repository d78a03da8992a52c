// Static equilibrium by Newton's method,
//   F_springs(u) + F_loads = 0,
// in load steps that are halved (cutback) if the method does not converge.
#include "failure.hpp"
#include "load_steps.hpp"

#include <equilibrium/systems.hpp>

#include <hyperlattice/rest.hpp>

#include <cmath>
#include <optional>
#include <stdexcept>

namespace hyperlattice {

class Static {
 public:
  struct Options {
    double tolerance = 1e-6;
    std::int64_t load_steps = 1, most_cutbacks = 10;
    std::optional<bool> stability;
    double damage_step = 0.05;
    bool snap_back = false;
    double overshoot = 1e-3;
    equilibrium::Preconditioner preconditioner = equilibrium::Preconditioner::automatic;
    std::optional<double> end_time;
    std::optional<RegionId> opening_from, opening_to;
    std::optional<Vec3> opening_direction;
    std::optional<double> opening_step, opening_end;
  };

  static Schema<Options> schema() {
    return Schema<Options>("solvers.static",
                           "A state of rest by Newton's method, geometrically nonlinear")
        .equation(
            "F_springs(u) + F_loads = 0;  K(u) du = F, K the exact tangent, by conjugate gradients "
            "with a multigrid V-cycle as preconditioner, of "
            "small listed lattices with a factorisation")
        .source("docs/theory/statics.md")
        .restrictions(
            "Springs break in states of rest, and loads are held, or fall with `snap_back`, until "
            "the body is at rest without them. The damage of cohesive materials grows between its "
            "states of rest. A law "
            "with a memory starts each load step with the memory of the last state "
            "of "
            "rest; the memory advances when the step is accepted, and no time passes for the law. "
            "A "
            "body that is a mechanism under its loads, or buckles, is an error that "
            "says where it moves. Energy is booked along the load "
            "steps by the trapezoidal rule: with large deformations in few steps the balance of "
            "this stage is as rough as that rule.")
        .add<&Options::tolerance>("tolerance", "",
                                  "residual at which the body is at rest: largest out-of-balance "
                                  "force over the mean force on held or loaded particles")
        .positive()
        .fallback("1e-6")
        .add<&Options::load_steps>("load_steps", "",
                                   "equal steps from the loads of the stage's start to those of "
                                   "its end; a step that fails is cut in halves; each is a "
                                   "state of rest of its own, so more than a million would outlast "
                                   "any run in steps of time")
        .at_least(1)
        .at_most(1e6)
        .fallback("1")
        .add<&Options::most_cutbacks>(
            "most_cutbacks", "",
            "times that a load step may be halved before the run fails; after 20 it is a "
            "millionth, which tells no load from the next")
        .at_least(0)
        .at_most(20)
        .fallback("10")
        .add<&Options::stability>("stability", "",
                                  "whether states of rest must be stable: each that took more than "
                                  "one tangent is searched for a motion along which its "
                                  "stiffness is negative; left out: of structured lattices without "
                                  "failure, as particles that hang on two springs buckle alone")
        .add<&Options::damage_step>("damage_step", "",
                                    "of cohesive materials: largest growth of a particle's damage "
                                    "from one state of rest to "
                                    "the next, which controls the load as cracks grow")
        .above(0)
        .at_most(1)
        .fallback("0.05")
        .add<&Options::snap_back>(
            "snap_back", "",
            "whether loads and time fall where a crack would run on under loads that are held, so "
            "that damage, or springs, go one after the other; if not, the crack runs to its next "
            "state of rest at once")
        .fallback("false")
        .add<&Options::overshoot>(
            "overshoot", "",
            "of failure criteria: how far elongations may be beyond the first failure, relative, "
            "when springs break; a load step that goes further is cut")
        .positive()
        .below(1)
        .fallback("1e-3")
        .add<&Options::opening_from>("opening_from", "",
                                     "control by an opening: the particles at one end; each state "
                                     "of rest then has a larger opening, by `opening_step`, and "
                                     "the load that it needs, which may fall")
        .add<&Options::opening_to>("opening_to", "",
                                   "the particles at the other end, as in probes.gauge")
        .add<&Options::opening_direction>(
            "opening_direction", "",
            "a direction fixed in space, of any length, along which the ends move apart; the "
            "present line between them if left out")
        .nonzero()
        .add<&Options::opening_step>("opening_step", "m",
                                     "growth of the opening from one state of rest to the next; "
                                     "load_steps and damage_step are then not used")
        .positive()
        .add<&Options::opening_end>("opening_end", "m",
                                    "opening at which the stage ends, if the load has not come to "
                                    "its end before; no other stage may follow then")
        .positive()
        .add<&Options::preconditioner>(
            "preconditioner", "",
            "of listed lattices: a factorisation of the tangent, whole or with no more entries "
            "than it has, or algebraic multigrid; automatic: whole "
            "up to 4000 numbers, multigrid beyond")
        .choices(equilibrium::preconditioner_names)
        .fallback("\"automatic\"")
        .add<&Options::end_time>("end_time", "s",
                                 "instant whose loads act at the end, from the start of the run; "
                                 "left out: when the last load has stopped changing")
        .at_least(0)
        .check([](const Options& o, const FaultSink& faults) {
          const bool controls = o.opening_from && o.opening_to && o.opening_step;
          const std::string expected = "all of opening_from, opening_to and opening_step, or none";
          if (!controls && (o.opening_from || o.opening_to || o.opening_step))
            faults.fault(o.opening_from ? "opening_from"
                         : o.opening_to ? "opening_to"
                                        : "opening_step",
                         expected);
          if (!controls && (o.opening_direction || o.opening_end))
            faults.fault(o.opening_direction ? "opening_direction" : "opening_end",
                         "opening_from, opening_to and opening_step beside it");
          if (controls && o.snap_back)
            faults.fault("snap_back", "false with an opening, with which loads fall anyway");
        });
  }

  explicit Static(const Options& options) : o_(options) {}

  SolverPlan plan(const SolverFacts& facts) const {
    SolverPlan plan = plan_of_rest(facts, o_.end_time);
    plan.steps = static_cast<std::uint64_t>(o_.load_steps);
    if (o_.opening_step) {
      const Vec3 apart = facts.middle(*o_.opening_to) - facts.middle(*o_.opening_from);
      if (!o_.opening_direction && apart == Vec3{})
        throw std::runtime_error(
            "opening_to whose mean place is not that of opening_from, or an opening_direction");
      constexpr double guessed = 50, most = 1e6;  // steps
      plan.steps = static_cast<std::uint64_t>(
          o_.opening_end ? std::min(most, std::ceil(*o_.opening_end / *o_.opening_step)) : guessed);
    }
    plan.sweeps_per_step =
        facts.listed
            ? 2200
            : 400;  // measured, set-up included: a compact grid takes 250, a slender one 550
    plan.bytes_per_site = facts.listed ? 11000 : 1700;
    plan.grows_damage = true;
    plan.resumes = true;
    if (facts.damages) {  // measured: a particle's damage grows to 1 while its neighbours' do
      plan.steps += static_cast<std::uint64_t>(3 / o_.damage_step);
      plan.sweeps_per_step *= 20;
    }
    return plan;
  }

  void run(const SolverFacts& facts, SolverHost& host) const {
    const bool is_resumed = host.steps_done > 0;
    if (!is_resumed && !host.observe()) return;
    const StaticProblem* problem = host.statics();
    if (problem == nullptr) return;
    const std::unique_ptr<equilibrium::System> system =
        equilibrium::make_system(*problem, o_.preconditioner);
    const bool stable = o_.stability.value_or(!facts.listed && !problem->damages && !facts.breaks);
    equilibrium::Newton newton(*system, host, {.tolerance = o_.tolerance, .stable = stable});
    const double whole = o_.opening_step.value_or(1 / static_cast<double>(o_.load_steps));
    std::optional<equilibrium::Opening::Ends> opening;
    if (o_.opening_step) opening = {*o_.opening_from, *o_.opening_to, o_.opening_direction};
    double overshoot = infinity;
    if (facts.breaks) overshoot = o_.overshoot;
    equilibrium::LoadSteps steps(
        *problem, host, newton,
        {.longest = whole,
         .shortest = whole * std::exp2(-static_cast<double>(o_.most_cutbacks)),
         .damage_step = o_.damage_step,
         .overshoot = overshoot,
         .snap_back = o_.snap_back,
         .opening = opening,
         .opening_end = o_.opening_end.value_or(infinity)});
    if (is_resumed) steps.recall(host.kept);
    if (steps.run()) return;
    const equilibrium::Outcome& found = steps.outcome();
    if (found.at_rest || newton.stopped()) return;  // the host has ended the stage
    if (!found.direction.empty() && !host.show_motion(found.direction.data())) return;
    const double start = facts.start_time,
                 time = start + steps.share() * (plan(facts).end_time - start);
    throw std::runtime_error(
        equilibrium::failure_text(*problem, {steps.share(), time, problem->broke}, found));
  }

 private:
  Options o_;
};

}  // namespace hyperlattice

HYPERLATTICE_PLUGIN("1.0") { plugin.add<hyperlattice::Static>(); }
