// A solver: the order of steps in time, or a way to a state of rest. What a step does to every
// particle is a kernel's work (kernels/); when outputs are due is the core's.
#pragma once

#include <hyperlattice/component.hpp>
#include <hyperlattice/statics.hpp>

namespace hyperlattice {

/// What a solver may know before the run.
struct SolverFacts {
  double start_time = 0;            ///< seconds; where the stage before ended
  double critical_time_step = 0;    ///< seconds, undamped: 2 / omega_max
  std::span<const double> corners;  ///< times where a load has a kink, ascending
  std::int32_t sites_across = 1;    ///< of the longest side of the box that the body fills
  bool listed = false;              ///< a list of particles and springs
  bool tangents = true;  ///< the law says how its force changes with the elongation; if not, there
                         ///< are no statics()
  bool answering = false;  ///< a load answers to the motion; statics() does not know such loads
};

/// What the solver will do, for `plan`, `summary.json` and the progress line.
struct SolverPlan {
  double end_time = 0;
  double time_step = 0;         ///< the largest step that will be taken, seconds
  double stable_time_step = 0;  ///< the limit that holds for this scheme, seconds
  double damping = 0;           ///< local damping, alpha; 0: none
  std::uint64_t steps = 0;
  /// The stage looks for a state of rest: its steps are not steps in time, time_step may be 0.
  /// Loads act as they do at end_time.
  bool at_rest = false;
  bool resumes =
      false;  ///< run() can go on in the middle of a stage, after SolverHost::steps_done steps
  double bytes_per_site =
      0;  ///< that the solver needs besides the state, for each site of the box around the body
  double sweeps_per_step = 1;  ///< evaluations of all springs that a step takes, about
};

/// The running simulation as a solver sees it.
struct SolverHost {
  void* self = nullptr;
  double time = 0;  ///< seconds; advanced by step()
  std::uint64_t steps_done =
      0;  ///< of this stage, by the run that this one goes on with; that state was observed
  bool (*take_step)(void* self, double time_step) noexcept = nullptr;
  bool (*show)(void* self) noexcept = nullptr;

  /// One step of central differences: v(n+1/2) = v(n-1/2) + dt a(n); u(n+1) = u(n) + dt v(n+1/2).
  /// False: the run must stop.
  bool step(double time_step) const { return take_step(self, time_step); }
  /// Lets history, probes and writers see the present state if they are due. Called once before the
  /// first step, then after each. False: stop.
  bool observe() const { return show(self); }

  // For stages that look for a state of rest.
  const StaticProblem* (*open)(void* self) noexcept = nullptr;
  bool (*take)(void* self, double share, const double* displacement) noexcept = nullptr;
  bool (*measure_rest)(void* self, RestReport* report, double* kinetic) noexcept = nullptr;
  bool (*stop_motion)(void* self) noexcept = nullptr;
  void (*set_damping_rate)(void* self, double rate) noexcept = nullptr;
  bool (*show_rest)(void* self, const RestReport& report) noexcept = nullptr;
  bool (*keep_motion)(void* self, const double* motion) noexcept = nullptr;

  /// The body for a static solver, built when first asked for; valid during the stage. Null: the
  /// run must stop.
  const StaticProblem* statics() const { return open(self); }
  /// Makes displacements the state, at rest, with that share of the stage's load. False: the run
  /// must stop.
  bool accept(double share, const double* displacement) const {
    return take(self, share, displacement);
  }
  /// Residual and estimated error of the present state, one evaluation of all springs, and its
  /// kinetic energy, J, which costs little. Either may be null. The error compares states: it is
  /// known from the third call on. False: the run must stop.
  bool measure(RestReport* report, double* kinetic) const {
    return measure_rest(self, report, kinetic);
  }
  bool halt() const { return stop_motion(self); }  ///< all velocities to zero
  /// Of the steps of this stage that follow: each particle feels a drag of rate (1/s) times its
  /// mass and velocity, the mean of those before and after.
  void damp(double rate) const { set_damping_rate(self, rate); }
  bool report(const RestReport& report) const {
    return show_rest(self, report);
  }  ///< for the progress line and the summary
  /// Keeps for the user how the body moves where there is no state of rest: a field like a
  /// displacement, of any size.
  bool show_motion(const double* motion) const { return keep_motion(self, motion); }
};

struct SolverFunctions {
  bool (*plan)(const void* solver, const SolverFacts& facts, SolverPlan& plan,
               const Complaint& why) noexcept;
  bool (*run)(const void* solver, const SolverFacts& facts, SolverHost& host,
              const Complaint& why) noexcept;
};

/// A solver class has: SolverPlan plan(const SolverFacts&) const, which throws when what the scene
/// asks for would be unstable; and void run(const SolverFacts&, SolverHost&) const.
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

#include <hyperlattice/boundary.hpp>  // the gate, once all that a family hands over is known
