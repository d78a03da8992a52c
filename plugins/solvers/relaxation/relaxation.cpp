// Dynamic relaxation: a damped motion that ends in a state of rest.
//
//   local damping (the paper's method):
//     v(n+1/2) = v(n-1/2) + dt (F - alpha |F| sign v) / m,   dt < dt_c / sqrt(1 + alpha)
//   accelerated, j steps after the last restart; a restart follows when the kinetic energy falls:
//     v(n+1/2) = a v(n-1/2) + (1 + a) / 2 dt F / m,   a = j / (j + 3)
//     (the same as a drag of 6 m v / ((2 j + 3) dt))
//
// The motion ends when the residual (the largest out-of-balance force over the mean force on held
// or loaded particles) is small, and the estimated error of the displacements too if the scene sets
// displacement_error. Loads have their values at end_time.
#include <hyperlattice/rest.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

namespace hyperlattice {

enum class Damping : std::uint32_t { local_damping, accelerated };
inline constexpr std::string_view damping_names[] = {"local_damping", "accelerated"};

/// The drag of the accelerated method. It removes all momentum at a restart, then less with each
/// step.
class Acceleration {
 public:
  explicit Acceleration(double time_step) : time_step_(time_step) {}

  /// Sets the drag of the next step. Returns false if the run must stop.
  bool set_drag(const SolverHost& host) {
    constexpr std::uint64_t every = 4;  // steps between two measurements of the kinetic energy
    constexpr double fallen = 0.8;      // of the maximum since the restart; short waves disturb it
    double kinetic = 0;
    if (since_ > 0 && since_ % every == 0) {
      if (!host.measure(nullptr, &kinetic)) return false;
      if (kinetic < fallen * largest_) since_ = 0;
      largest_ = since_ == 0 ? 0 : std::max(largest_, kinetic);
    }
    host.damp(6 / (static_cast<double>(2 * since_ + 3) * time_step_));
    ++since_;
    return true;
  }

  double largest() const { return largest_; }     ///< kinetic energy since the last restart, J
  std::uint64_t since() const { return since_; }  ///< steps since then
  /// Goes on with these two.
  void recall(double largest, std::uint64_t since) {
    largest_ = largest;
    since_ = since;
  }

 private:
  double time_step_, largest_ = 0;
  std::uint64_t since_ = 0;
};

class Relaxation {
 public:
  struct Options {
    Damping method = Damping::local_damping;
    double damping = 0.8, tolerance = 1e-5, safety = 0.9;
    std::int64_t most_steps = 1'000'000;
    std::optional<double> displacement_error, end_time, time_step;
  };

  static Schema<Options> schema() {
    return Schema<Options>("solvers.relaxation",
                           "A state of rest by damped motion in steps of central differences")
        .equation(
            "local_damping: m a = F - damping |F| sign(v), dt < dt_c / sqrt(1 + damping); "
            "accelerated: m a = F - 6 m v / ((2 j + 3) dt), dt < dt_c, "
            "j steps since the kinetic energy last fell")
        .source(
            "Zhao 2017, section 2.2 (local damping); Nesterov's acceleration as a drag that falls "
            "with time, with restarts (Su, Boyd and Candes "
            "2016); limit: 2 / omega_max of the lattice by Bloch analysis")
        .restrictions(
            "Time stands still at end_time, and so do the loads. Springs may break on the way, as "
            "in any motion. The residual is not the error of "
            "the displacements: of slender bodies that is a thousand times larger. "
            "displacement_error asks for it.")
        .add<&Options::method>("method", "",
                               "how motion is damped; accelerated takes a fifth to a third of the "
                               "steps, local_damping is the paper's")
        .choices(damping_names)
        .fallback("\"local_damping\"")
        .add<&Options::damping>("damping", "", "alpha of local_damping")
        .at_least(0)
        .below(1)
        .fallback("0.8")
        .add<&Options::tolerance>("tolerance", "", "residual at which the body is at rest")
        .positive()
        .fallback("1e-5")
        .add<&Options::displacement_error>("displacement_error", "",
                                           "estimated error of the displacements, a share of them, "
                                           "above which the body is not at rest; left out: any")
        .positive()
        .add<&Options::end_time>("end_time", "s",
                                 "instant whose loads act, from the start of the run; left out: "
                                 "when the last load has stopped changing")
        .at_least(0)
        .add<&Options::time_step>("time_step", "s",
                                  "auto: the fraction `safety` of the stable one; a number above "
                                  "the stable step is refused")
        .word("auto")
        .fallback("\"auto\"")
        .positive()
        .add<&Options::safety>("safety", "",
                               "fraction of the stable step that auto takes; 0.8 for large strains")
        .above(0)
        .below(1)
        .fallback("0.9")
        .add<&Options::most_steps>("most_steps", "", "after so many the run fails")
        .at_least(1)
        .at_most(1e12)
        .fallback("1e6");
  }

  explicit Relaxation(const Options& options) : o_(options) {}

  SolverPlan plan(const SolverFacts& facts) const {
    if (facts.remembers)
      throw std::runtime_error(
          "laws without memory, which would follow the motion on the way to rest; a body with such "
          "a law comes to rest by solvers.static, or by steps in time with damping");
    SolverPlan plan = plan_of_rest(facts, o_.end_time);
    plan.resumes = true;
    plan.bytes_per_site = 250;  // for the measurement of the residual
    plan.damping = alpha();
    plan.stable_time_step = facts.critical_time_step / std::sqrt(1 + plan.damping);
    plan.time_step = o_.time_step.value_or(o_.safety * plan.stable_time_step);
    if (!(plan.time_step <= plan.stable_time_step))
      throw std::runtime_error("time_step of at most " + short_number(plan.stable_time_step) +
                               " s, the stable limit");
    const double digits = std::max(1.0, -std::log10(o_.tolerance)),
                 per_site = o_.method == Damping::accelerated ? 1.5 : 7.5;  // measured on cubes
    plan.steps = static_cast<std::uint64_t>(
        std::min(static_cast<double>(o_.most_steps), per_site * digits * facts.sites_across + 20));
    return plan;
  }

  void run(const SolverFacts& facts, SolverHost& host) const {
    constexpr std::uint64_t every = 20;  // steps; one measurement costs about two steps
    const double time_step = plan(facts).time_step;
    RestReport report;
    Acceleration acceleration(time_step);
    bool is_resumed = host.steps_done > 0;
    if (is_resumed)
      recall(host.kept, report, acceleration);
    else if (!host.observe())
      return;
    while (report.iterations < static_cast<std::uint64_t>(o_.most_steps) || is_resumed) {
      if (!is_resumed) {
        if (o_.method == Damping::accelerated && !acceleration.set_drag(host)) return;
        const bool goes_on = host.step(time_step);
        ++report.iterations;
        keep(host, report, acceleration);
        if (!goes_on) return;
      }
      is_resumed = false;  // what follows a step may be missing: to do it again changes nothing
      if (report.iterations % every == 0 && !host.measure(&report, nullptr)) return;
      if (!host.report(report) || !host.observe()) return;
      if (report.iterations % every == 0 && at_rest(report)) {
        host.halt();
        return;
      }
    }
    std::string why = "the residual is " + short_number(report.residual) + ", and tolerance " +
                      short_number(o_.tolerance);
    if (o_.displacement_error)
      why += "; the estimated error of the displacements " +
             short_number(report.displacement_error) + ", and displacement_error " +
             short_number(*o_.displacement_error);
    throw std::runtime_error("the body is not at rest after " +
                             short_number(static_cast<double>(o_.most_steps)) + " steps: " + why);
  }

 private:
  /// Keeps what the next step and measurement need, so that a checkpoint may be taken here.
  static void keep(const SolverHost& host, const RestReport& report,
                   const Acceleration& acceleration) {
    host.keep(std::array{static_cast<double>(report.iterations), report.residual,
                         report.displacement_error, acceleration.largest(),
                         static_cast<double>(acceleration.since())});
  }
  static void recall(std::span<const double> kept, RestReport& report, Acceleration& acceleration) {
    if (kept.size() != 5) throw std::runtime_error("the checkpoint is of another solver");
    report.iterations = static_cast<std::uint64_t>(kept[0]);
    report.residual = kept[1];
    report.displacement_error = kept[2];
    acceleration.recall(kept[3], static_cast<std::uint64_t>(kept[4]));
  }
  bool at_rest(const RestReport& report) const {
    const double error = report.displacement_error;
    return report.residual <= o_.tolerance &&
           (!o_.displacement_error || (error >= 0 && error <= *o_.displacement_error));
  }
  double alpha() const { return o_.method == Damping::accelerated ? 0 : o_.damping; }

  Options o_;
};

}  // namespace hyperlattice

HYPERLATTICE_PLUGIN("1.0") { plugin.add<hyperlattice::Relaxation>(); }
