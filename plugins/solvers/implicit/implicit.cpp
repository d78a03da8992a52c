// Implicit dynamics, stable for steps of any length. Each step solves for the mean displacement w,
//   m (w - u - g h v) / (g h)^2 = f(u, w) + F,   u' = u + (w - u) / g,
// by Newton's method with the tangent of statics plus inertia on its diagonal. The part g of the
// step is 1/2 without numerical damping: the method is then of second order and keeps the energy of
// linear springs, momentum and angular momentum (docs/theory/implicit.md).
#include "step_length.hpp"

#include <equilibrium/search_memory.hpp>
#include <equilibrium/systems.hpp>

#include <hyperlattice/files.hpp>
#include <hyperlattice/solver.hpp>

#include <cmath>
#include <optional>
#include <stdexcept>

namespace hyperlattice {

class Implicit {
 public:
  struct Options {
    double end_time = 0;
    std::optional<double> time_step;
    double tolerance = 1e-4, residual = 1e-6, damping = 0, overshoot = 1e-2, damage_step = 0.02;
    equilibrium::Preconditioner preconditioner = equilibrium::Preconditioner::automatic;
  };

  static Schema<Options> schema() {
    return Schema<Options>("solvers.implicit",
                           "Implicit dynamics for stiff and slow scenes, up to an instant")
        .equation(
            "m (v' - v) / h = f + F,  (u' - u) / h = v + g (v' - v),  g = (1 + damping) / 2; "
            "forces of springs at mean elongations, along mean directions")
        .source(
            "LaBudde and Greenspan, Numer. Math. 25 (1976) 323-346 and 26 (1976) 1-16; "
            "docs/theory/implicit.md")
        .restrictions(
            "No nodal volumes of lists. Springs break at the ends of steps. Damage of cohesive "
            "materials follows the stress without delay. Loads act by their mean over each step; "
            "those that answer to the motion, by their answer to the mean motion.")
        .add<&Options::end_time>("end_time", "s",
                                 "instant at which the stage ends, counted from the start of the "
                                 "whole run, not of the stage")
        .example("\"20 ms\"")
        .positive()
        .add<&Options::time_step>(
            "time_step", "s",
            "longest step, of any length; a step whose equations cannot be solved is halved; auto: "
            "from `tolerance`")
        .word("auto")
        .fallback("\"auto\"")
        .example("\"0.1 ms\"")
        .positive()
        .add<&Options::tolerance>("tolerance", "",
                                  "of automatic steps: error of the displacements in one step over "
                                  "the largest displacement so far, root mean squares")
        .positive()
        .below(1)
        .fallback("1e-4")
        .add<&Options::residual>("residual", "",
                                 "residual at which a step is solved: largest out-of-balance force "
                                 "over the mean force of springs or loads")
        .positive()
        .below(1)
        .fallback("1e-6")
        .add<&Options::damping>(
            "damping", "",
            "numerical damping of fast motions: 0 keeps energy, 1 is Euler's backward method; in "
            "each step, motions much faster than it shrink to (1 - damping) / (1 + damping); with "
            "damping the method is of first order")
        .at_least(0)
        .at_most(1)
        .fallback("0")
        .add<&Options::overshoot>(
            "overshoot", "",
            "of failure criteria: how far elongations may be beyond the first failure, relative, "
            "when springs break; a step that goes further is cut, to the critical step of explicit "
            "solvers at least")
        .positive()
        .below(1)
        .fallback("1e-2")
        .add<&Options::damage_step>(
            "damage_step", "",
            "of cohesive materials: growth of a particle's damage in a step beyond which the next "
            "step is shorter, to the critical step at least")
        .above(0)
        .at_most(1)
        .fallback("0.02")
        .add<&Options::preconditioner>(
            "preconditioner", "",
            "of listed lattices: a factorisation of the tangent, whole or with no more entries "
            "than it has, or algebraic multigrid; automatic: whole up to 4000 numbers, multigrid "
            "beyond")
        .choices(equilibrium::preconditioner_names)
        .fallback("\"automatic\"");
  }

  explicit Implicit(const Options& options) : o_(options) {}

  SolverPlan plan(const SolverFacts& facts) const {
    if (facts.nodal_volumes)
      throw std::runtime_error(
          "a list without nodal volumes, or a structured lattice; explicit steps have both");
    if (!(o_.end_time > facts.start_time))
      throw std::runtime_error(
          "end_time after " + short_number(facts.start_time) +
          " s, where the stage starts: it counts from the start of the whole run");
    SolverPlan plan;
    plan.end_time = o_.end_time;
    plan.stable_time_step = infinity;
    plan.resumes = true;
    const double length = o_.end_time - facts.start_time;
    constexpr double guessed_steps = 500;  // of automatic steps
    const double parts =
        std::ceil(length / o_.time_step.value_or(length / guessed_steps) * (1 - 1e-12));
    if (!(parts < 1e15))
      throw std::runtime_error(
          "a longer time step or an earlier end: this would take more than 1e15 steps");
    plan.steps = static_cast<std::uint64_t>(std::max(1.0, parts));
    plan.time_step = length / static_cast<double>(plan.steps);
    plan.sweeps_per_step = facts.listed ? 600 : 120;
    plan.bytes_per_site = facts.listed ? 11000 : 1700;
    return plan;
  }

  void run(const SolverFacts& facts, SolverHost& host) const {
    const SolverPlan planned = plan(facts);
    if (host.steps_done == 0 && !host.observe()) return;
    const StaticProblem* problem = host.motion();
    if (problem == nullptr) return;
    const std::unique_ptr<equilibrium::System> system =
        equilibrium::make_system(*problem, o_.preconditioner);
    equilibrium::Newton newton(*system, host, {.tolerance = o_.residual, .stable = false});
    const double forward = (1 + o_.damping) / 2, length = planned.end_time - facts.start_time;
    implicit::StepLength steps =
        o_.time_step ? implicit::StepLength(planned.time_step, planned.time_step, 0)
                     : implicit::StepLength(std::min(first_step * facts.critical_time_step, length),
                                            length, o_.tolerance);
    if (!host.kept.empty()) steps.recall(equilibrium::recall(host.kept, newton));
    const std::size_t numbers = problem->grid.numbers();
    equilibrium::Field mean(numbers), change(numbers), end(numbers);
    while (host.time < planned.end_time) {
      const double h = steps.next(planned.end_time - host.time);
      problem->begin_step({h, forward});
      std::copy_n(problem->state, numbers, mean.begin());
      for (std::size_t n = 0; n < steps.velocity().size(); ++n)
        mean[n] += forward * h * steps.velocity()[n];
      const equilibrium::Outcome found = newton.solve_load_step(1, mean);
      if (newton.stopped()) return;
      if (found.at_rest && facts.breaks && h > facts.critical_time_step &&
          problem->overshoot(1, mean.data()) > o_.overshoot) {
        steps.cut(h / 2, facts.critical_time_step);
        continue;
      }
      if (!found.at_rest) {
        if (steps.shorten(h)) continue;
        throw std::runtime_error(failure_text(host.time, h, found));
      }
      for (std::size_t n = 0; n < numbers; ++n) {
        change[n] = (mean[n] - problem->state[n]) / forward;
        end[n] = problem->state[n] + change[n];
      }
      if (!steps.accept(h, change, end)) continue;
      const bool goes_on = host.accept_step(mean.data());
      if (problem->growth > o_.damage_step)
        steps.cut(h * o_.damage_step / problem->growth, facts.critical_time_step);
      keep(host, newton, steps);
      if (!goes_on || !host.observe()) return;
    }
  }

 private:
  static constexpr double first_step = 2;  // automatic, of the critical step

  /// Keeps what the next step needs, so that a checkpoint may be taken here.
  static void keep(const SolverHost& host, const equilibrium::Newton& newton,
                   const implicit::StepLength& steps) {
    std::vector<double> all;
    equilibrium::remember(newton, all);
    steps.remember(all);
    host.keep(all);
  }

  static std::string failure_text(double time, double h, const equilibrium::Outcome& found) {
    return "the step of " + short_number(h) + " s from " + short_number(time) +
           " s has no solution: " +
           (found.why.empty() ? "Newton's method does not converge" : found.why);
  }

  Options o_;
};

}  // namespace hyperlattice

HYPERLATTICE_PLUGIN("1.0") { plugin.add<hyperlattice::Implicit>(); }
