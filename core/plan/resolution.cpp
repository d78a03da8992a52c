#include <plan/resolution.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hyperlattice {
namespace {

/// By which share the mean over a step, of sin(2 pi f t) with so many steps a period, is below its amplitude.
double lost_by_mean(double steps_a_period) {
  const double half_phase = std::numbers::pi / steps_a_period;
  return 1 - std::sin(half_phase) / half_phase;
}

/// Two corners of a load, less than two steps apart, between which or at which its factor changes by more than a tenth of its largest value.
struct ShortPiece {
  double from = 0, to = 0;  ///< s
  bool found = false;
};

ShortPiece shortest(const Load& load, const PlannedStage& stage) {
  constexpr double enough_steps = 2, round_off = 1e-6, share = 0.1;
  const double step = stage.plan.time_step, nearby = round_off * step;
  std::vector<double> ends{0};
  ends.insert(ends.end(), load.corners.begin(), load.corners.end());
  double largest = std::abs(load.factor(stage.plan.end_time));
  for (std::size_t n = 0; n + 1 < ends.size(); ++n) largest = std::max(largest, std::abs(load.factor(0.5 * (ends[n] + ends[n + 1]))));
  ShortPiece shortest{0, enough_steps * step * (1 - round_off), false};
  for (std::size_t n = 0; n + 1 < ends.size(); ++n) {
    const double from = ends[n], to = ends[n + 1], length = to - from;
    if (to < stage.start_time || from > stage.plan.end_time || !(length > nearby) || !(length < (1 - round_off) * (shortest.to - shortest.from)))
      continue;
    const double edge = 1e-3 * length;
    double least = infinity, most = -infinity;
    for (const double time : {from - edge, from + edge, 0.5 * (from + to), to - edge, to + edge}) {
      least = std::min(least, load.factor(time));
      most = std::max(most, load.factor(time));
    }
    if (most - least > share * largest) shortest = {from, to, true};
  }
  return shortest;
}

}  // namespace

void check_resolution(Plan& plan, Faults& faults) {
  constexpr double fewest = 2, good = 20;  // steps a period
  for (const Load& load : plan.model->loads) {
    const std::string name = fmt::format("{} ({})", load.stage->component->type(), load.stage->pointer);
    const PlannedStage* coarsest = nullptr;
    for (const PlannedStage& stage : plan.stages)
      if (!stage.plan.at_rest && stage.plan.time_step > 0 && (coarsest == nullptr || stage.plan.time_step > coarsest->plan.time_step))
        coarsest = &stage;
    if (coarsest == nullptr) continue;
    const double step = coarsest->plan.time_step;
    if (load.frequency > 0) {
      const double steps = 1 / (load.frequency * step);
      if (steps < fewest * (1 - 1e-9))
        faults.add(load.stage->pointer, fmt::format("{:.6g} Hz", load.frequency),
                   fmt::format("at most {:.4g} Hz, half a period a step of {:.4g} s ({}); or a time_step of at most {:.4g} s, 20 steps a period",
                               1 / (fewest * step), step, coarsest->stage->pointer, 1 / (good * load.frequency)));
      else if (steps < good)
        plan.model->warnings.push_back(
            fmt::format("{}: a period of its {:.4g} Hz is {:.3g} steps of {}; the mean over a step takes {:.2g} % off its amplitude. 20 steps a "
                        "period take off 0.4 %: a time_step of {:.4g} s",
                        name, load.frequency, steps, coarsest->stage->pointer, 100 * lost_by_mean(steps), 1 / (good * load.frequency)));
    }
    ShortPiece piece;
    for (const PlannedStage& stage : plan.stages) {
      if (stage.plan.at_rest || !(stage.plan.time_step > 0)) continue;
      piece = shortest(load, stage);
      if (!piece.found) continue;
      plan.model->warnings.push_back(
          fmt::format("{}: from {:.4g} s to {:.4g} s it changes within {:.2g} steps of {}. Its impulse is exact, but its shape needs two steps or "
                      "more: a time_step of at most {:.3g} s",
                      name, piece.from, piece.to, (piece.to - piece.from) / stage.plan.time_step, stage.stage->pointer, (piece.to - piece.from) / 2));
      break;
    }
  }
}

}  // namespace hyperlattice
