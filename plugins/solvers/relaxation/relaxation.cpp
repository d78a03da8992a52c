// To a state of rest by motion that is damped:
//
//   local damping (the paper's way):  v(n+1/2) = v(n-1/2) + dt (F - alpha |F| sign v) / m,  dt < dt_c / sqrt(1 + alpha)
//   kinetic damping:                  undamped steps; at each peak of the kinetic energy all velocities are set to zero
//
// until the residual, the largest out-of-balance force over the mean force on held or loaded particles, is small. Loads act as they do at the end.
#include <hyperlattice/rest.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

namespace hyperlattice {

enum class Damping : std::uint32_t { local_damping, kinetic };
inline constexpr std::string_view damping_names[] = {"local_damping", "kinetic"};

class Relaxation {
 public:
  struct Options {
    Damping method = Damping::local_damping;
    double damping = 0.8, tolerance = 1e-5, safety = 0.9, most_steps = 1e6;
    std::optional<double> end_time, time_step;
  };

  static Schema<Options> schema() {
    return Schema<Options>("solvers.relaxation", "A state of rest by damped motion in steps of central differences")
        .equation("local_damping: m a = F - damping |F| sign(v), dt < dt_c / sqrt(1 + damping); kinetic: v = 0 at each peak of the kinetic energy")
        .source("Zhao 2017, section 2.2 (local damping); Cundall's kinetic damping; limit: 2 / omega_max of the lattice by Bloch analysis")
        .restrictions(
            "Time stands still at end_time, and so do the loads. Springs may break on the way, as in any motion. The residual is not the error of "
            "the "
            "displacements, which is larger for slender bodies; solvers.static says both.")
        .add<&Options::method>("method", "", "how motion is damped; kinetic takes fewer steps, local_damping is the paper's")
        .choices(damping_names)
        .fallback("\"local_damping\"")
        .add<&Options::damping>("damping", "", "alpha of local damping; of kinetic damping besides, where it takes a tenth of it")
        .at_least(0)
        .below(1)
        .fallback("0.8")
        .add<&Options::tolerance>("tolerance", "", "residual at which the body is at rest")
        .positive()
        .fallback("1e-5")
        .add<&Options::end_time>("end_time", "s",
                                 "instant whose loads act, from the start of the run; left out: when the last load has stopped changing")
        .at_least(0)
        .add<&Options::time_step>("time_step", "s", "auto: the fraction `safety` of the stable one; a number above the stable step is refused")
        .word("auto")
        .fallback("\"auto\"")
        .positive()
        .add<&Options::safety>("safety", "", "fraction of the stable step that auto takes; 0.8 for large strains")
        .above(0)
        .below(1)
        .fallback("0.9")
        .add<&Options::most_steps>("most_steps", "", "after so many the run fails")
        .at_least(1)
        .fallback("1e6");
  }

  explicit Relaxation(const Options& options) : o_(options) {}

  SolverPlan plan(const SolverFacts& facts) const {
    SolverPlan plan = plan_of_rest(facts, o_.end_time);
    plan.bytes_per_site = 250;  // of the measurement of the residual
    plan.damping = alpha();
    plan.stable_time_step = facts.critical_time_step / std::sqrt(1 + plan.damping);
    plan.time_step = o_.time_step.value_or(o_.safety * plan.stable_time_step);
    if (!(plan.time_step <= plan.stable_time_step))
      throw std::runtime_error("time_step of at most " + short_number(plan.stable_time_step) + " s, the stable limit");
    const double digits = std::max(1.0, -std::log10(o_.tolerance)), per_site = o_.method == Damping::kinetic ? 1.3 : 7.5;  // as cubes take
    plan.steps = static_cast<std::uint64_t>(std::min(o_.most_steps, per_site * digits * facts.sites_across + 20));
    return plan;
  }

  void run(const SolverFacts& facts, SolverHost& host) const {
    constexpr std::uint64_t every = 20;  // steps; a measurement of the residual costs about two
    const double time_step = plan(facts).time_step;
    RestReport report;
    double kinetic = 0, before = 0;
    if (!host.observe()) return;
    while (static_cast<double>(report.iterations) < o_.most_steps) {
      if (!host.step(time_step)) return;
      ++report.iterations;
      if (o_.method == Damping::kinetic) {
        if (!host.measure(nullptr, &kinetic)) return;
        if (kinetic < before && !host.halt()) return;
        before = kinetic < before ? 0 : kinetic;
      }
      if (report.iterations % every == 0 && !host.measure(&report.residual, nullptr)) return;
      if (!host.report(report) || !host.observe()) return;
      if (report.iterations % every == 0 && report.residual <= o_.tolerance) {
        host.halt();
        return;
      }
    }
    throw std::runtime_error("the body is not at rest after " + short_number(o_.most_steps) + " steps: the residual is " +
                             short_number(report.residual) + ", and tolerance " + short_number(o_.tolerance));
  }

 private:
  double alpha() const { return o_.method == Damping::kinetic ? 0.1 * o_.damping : o_.damping; }

  Options o_;
};

}  // namespace hyperlattice

HYPERLATTICE_PLUGIN("1.0") { plugin.add<hyperlattice::Relaxation>(); }
