#include <plan/calibration.hpp>
#include <plan/estimates.hpp>
#include <process/room.hpp>
#include <state/simulation.hpp>

#include <algorithm>
#include <chrono>
#include <exception>

namespace hyperlattice {

namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Returns the seconds per step: the least mean of several short measurements, because other work
/// on the machine only adds to it.
double measure_step(const Plan& plan) {
  constexpr double spell = 0.05;  // s
  constexpr int spells = 5, most_steps = 200;
  Simulation simulation(*plan.model, plan.threads);
  // The step is so short that the body stays at rest under any load.
  const double shortest = 1e-6 * plan.model->step_limit.time_step;
  simulation.step(shortest);  // the first step also finds the energy at the start
  double least = infinity;
  for (int n = 0; n < spells; ++n) {
    const auto start = Clock::now();
    int steps = 0;
    double seconds = 0;
    while (steps < most_steps && (steps == 0 || seconds < spell)) {
      simulation.step(shortest);
      ++steps;
      seconds = seconds_since(start);
    }
    least = std::min(least, seconds / steps);
  }
  return least;
}

}  // namespace

void calibrate_run_time(Plan& plan) try {
  constexpr double most_bytes = 1e9;
  const double state = plan.bytes_per_particle * static_cast<double>(plan.model->body.particles);
  if (state > most_bytes || 2 * state > memory_room().bytes) return;
  const double step = measure_step(plan);
  double seconds = 0;
  for (const PlannedStage& stage : plan.stages)
    seconds += step * static_cast<double>(stage.plan.steps) * stage.plan.sweeps_per_step;
  plan.expected_seconds = seconds + output_seconds(plan, step, true);
} catch (const std::exception&) {  // the run itself reports steps that fail
}

}  // namespace hyperlattice
