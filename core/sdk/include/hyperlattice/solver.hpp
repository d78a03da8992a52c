// A solver: a sequence of time steps, or a method that finds a state of rest. A kernel computes
// what a step does to each particle (kernels/); the core decides when outputs are due.
#pragma once

#include <hyperlattice/component.hpp>
#include <hyperlattice/statics.hpp>

#include <stdexcept>
#include <string>

namespace hyperlattice {

/// A division of the body into stiff particles, which take several steps within one step of the
/// others.
struct LocalSteps {
  double time_step = 0;    ///< longest stable step of the other particles, s
  std::int64_t parts = 1;  ///< steps of the stiff particles within it
  double share = 0;        ///< of the particles that are stiff
  double cost = 1;         ///< time of a step over that of a step without such a division, about
};

/// Facts that a solver gets before the run.
struct SolverFacts {
  double start_time = 0;            ///< s; end of the previous stage
  double critical_time_step = 0;    ///< seconds, undamped: 2 / omega_max
  std::span<const double> corners;  ///< times, s, where a load has a kink or jump, ascending
  std::int32_t sites_across = 1;    ///< sites along the longest side of the body's box
  bool listed = false;              ///< the lattice is listed
  bool nodal_volumes = false;       ///< the particles of the list have volumetric energies
  bool remembers = false;  ///< a law has a memory, which advances with each accepted state of rest
  bool damages = false;    ///< materials are cohesive: their damage grows
  bool answering = false;  ///< a load answers to the motion; statics() does not include such loads
  bool breaks = false;     ///< springs may break by a failure criterion
  const void* self = nullptr;
  bool (*divide)(const void* self, std::int64_t parts, LocalSteps& steps,
                 const Complaint& why) noexcept = nullptr;
  bool (*find_middle)(const void* self, RegionId region, Vec3& middle,
                      const Complaint& why) noexcept = nullptr;

  /// Returns the division of the body into particles that take `parts` steps within one step of the
  /// others; the cheapest one if `parts` is 0. Throws std::runtime_error if the body allows none.
  LocalSteps local_steps(std::int64_t parts) const {
    LocalSteps steps;
    ask([&](const Complaint& why) { return divide(self, parts, steps, why); });
    return steps;
  }
  /// Returns the mean position of the particles of a region at rest, m. Throws std::runtime_error
  /// if it has none.
  Vec3 middle(RegionId region) const {
    Vec3 found;
    ask([&](const Complaint& why) { return find_middle(self, region, found, why); });
    return found;
  }

 private:
  template <class Question>
  static void ask(const Question& question) {
    std::string objection;
    const Complaint why{&objection, [](void* text, std::string_view sentence) noexcept {
                          *static_cast<std::string*>(text) = sentence;
                        }};
    if (!question(why)) throw std::runtime_error(objection);
  }
};

/// What the solver will do, for the plan, `summary.json` and the progress line.
struct SolverPlan {
  double end_time = 0;
  double time_step = 0;         ///< largest time step, s
  double stable_time_step = 0;  ///< stability limit of this scheme, s; infinite: it has none
  double damping = 0;           ///< local damping, alpha; 0: none
  std::uint64_t steps = 0;
  /// The stage searches a state of rest: its steps are not steps in time, and time_step may be 0.
  /// Loads have their values at end_time.
  bool at_rest = false;
  /// Whether a search without steps in time lets the damage of cohesive materials grow.
  bool grows_damage = false;
  /// Whether run() can continue in the middle of a stage, after SolverHost::steps_done steps.
  bool resumes = false;
  LocalSteps local;  ///< from SolverFacts::local_steps()
  /// Memory that the solver needs besides the state, for each site of the body's box, bytes.
  double bytes_per_site = 0;
  double sweeps_per_step = 1;  ///< approximate number of evaluations of all springs in a step
};

/// The running simulation as a solver sees it.
struct SolverHost {
  void* self = nullptr;
  double time = 0;  ///< seconds; advanced by step()
  /// Steps, or states of rest, of this stage done by the run that is resumed. That run has observed
  /// the present state of a step in time; a solver of states of rest observes its own again.
  std::uint64_t steps_done = 0;
  /// What the solver of that run kept last; else empty.
  std::span<const double> kept;
  bool (*take_step)(void* self, double time_step) noexcept = nullptr;
  bool (*show)(void* self) noexcept = nullptr;

  /// Makes one step of central differences: v(n+1/2) = v(n-1/2) + dt a(n); u(n+1) = u(n) + dt
  /// v(n+1/2). Returns false if the run must stop.
  bool step(double time_step) const { return take_step(self, time_step); }
  /// Shows the present state to history, probes and writers that are due. Call it once before the
  /// first step, then after each step. Returns false if the run must stop.
  bool observe() const { return show(self); }

  // For stages that search a state of rest.
  const StaticProblem* (*open)(void* self) noexcept = nullptr;
  bool (*take)(void* self, double share, const double* displacement) noexcept = nullptr;
  bool (*measure_rest)(void* self, RestReport* report, double* kinetic) noexcept = nullptr;
  bool (*stop_motion)(void* self) noexcept = nullptr;
  void (*set_damping_rate)(void* self, double rate) noexcept = nullptr;
  bool (*show_rest)(void* self, const RestReport& report) noexcept = nullptr;
  bool (*keep_motion)(void* self, const double* motion) noexcept = nullptr;
  const StaticProblem* (*open_motion)(void* self) noexcept = nullptr;
  bool (*take_motion)(void* self, const double* mean) noexcept = nullptr;
  void (*keep_numbers)(void* self, const double* numbers, std::size_t count) noexcept = nullptr;

  /// Gives the numbers that the solver needs, besides the state, to go on in the middle of the
  /// stage. Checkpoints hold the latest. A solver that needs some calls it after each step, before
  /// observe(), also if the run must stop.
  void keep(std::span<const double> numbers) const {
    keep_numbers(self, numbers.data(), numbers.size());
  }

  /// Returns the body for a static solver, built at the first call; valid during the stage. Null:
  /// the run must stop.
  const StaticProblem* statics() const { return open(self); }
  /// Sets the state to these displacements, at rest, under the fraction `share` of the stage's
  /// change of load. If springs break there (StaticProblem::broke), the next state that is accepted
  /// must be at rest without them, under the same loads or smaller ones. Returns false if the run
  /// must stop.
  bool accept(double share, const double* displacement) const {
    return take(self, share, displacement);
  }

  // For implicit steps in time.
  /// Returns the body for an implicit solver, built at the first call; valid during the stage, in
  /// which step() and accept() must not be called. Null: the run must stop.
  const StaticProblem* motion() const { return open_motion(self); }
  /// Ends the step that StaticProblem::begin_step() began with the mean displacements w. Returns
  /// false if the run must stop.
  bool accept_step(const double* mean) const { return take_motion(self, mean); }

  /// Computes the residual and the estimated error of the present state, with one evaluation of all
  /// springs, and its kinetic energy, J, at little cost. Either pointer may be null. The error
  /// compares successive states: it is known from the third call on. Returns false if the run must
  /// stop.
  bool measure(RestReport* report, double* kinetic) const {
    return measure_rest(self, report, kinetic);
  }
  bool halt() const { return stop_motion(self); }  ///< sets all velocities to zero
  /// Sets the damping of the following steps of this stage: the force rate (1/s) times mass and
  /// velocity, the mean of the velocities before and after the step.
  void damp(double rate) const { set_damping_rate(self, rate); }
  /// Reports to the progress line and the summary.
  bool report(const RestReport& report) const { return show_rest(self, report); }
  /// Stores for the user the motion of a body that has no state of rest: a field like a
  /// displacement, of any amplitude.
  bool show_motion(const double* motion) const { return keep_motion(self, motion); }
};

/// Functions of a solver across the boundary.
struct SolverFunctions {
  bool (*plan)(const void* solver, const SolverFacts& facts, SolverPlan& plan,
               const Complaint& why) noexcept;
  bool (*run)(const void* solver, const SolverFacts& facts, SolverHost& host,
              const Complaint& why) noexcept;
};

/// A solver class has: SolverPlan plan(const SolverFacts&) const, which throws if the scene asks
/// for unstable steps; and void run(const SolverFacts&, SolverHost&) const.
template <class T>
concept SolverComponent = requires(const T& solver, const SolverFacts& facts, SolverHost& host) {
  { solver.plan(facts) } -> std::convertible_to<SolverPlan>;
  solver.run(facts, host);
};

namespace detail {
template <SolverComponent T>
struct FunctionsOf<T> {
  static constexpr Family family = Family::solvers;
  static constexpr SolverFunctions table{
      [](const void* solver, const SolverFacts& facts, SolverPlan& plan,
         const Complaint& why) noexcept {
        return guarded(why, [&] { plan = static_cast<const T*>(solver)->plan(facts); });
      },
      [](const void* solver, const SolverFacts& facts, SolverHost& host,
         const Complaint& why) noexcept {
        return guarded(why, [&] { static_cast<const T*>(solver)->run(facts, host); });
      }};
};
}  // namespace detail
}  // namespace hyperlattice

#include <hyperlattice/boundary.hpp>  // the gate needs all structs of the boundary
