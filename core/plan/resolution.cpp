#include <plan/resolution.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace hyperlattice {
namespace {

/// Returns the relative loss of amplitude of sin(2 pi f t) in its mean over a step, for a number of
/// steps per period.
double lost_by_mean(double steps_a_period) {
  const double half_phase = std::numbers::pi / steps_a_period;
  return 1 - std::sin(half_phase) / half_phase;
}

/// Two corners of a load, less than two steps apart, at or between which its factor changes by more
/// than a tenth of its largest value.
struct ShortPiece {
  double from = 0, to = 0;  ///< s
  bool found = false;
};

/// The pieces of a load's factor, from one corner to the next.
struct Pieces {
  std::vector<double> ends;  ///< s, ascending: 0 and the corners
  double largest = 0;        ///< largest absolute factor in the middle of a piece
};

Pieces pieces_of(const Load& load) {
  Pieces pieces;
  pieces.ends.push_back(0);
  pieces.ends.insert(pieces.ends.end(), load.corners.begin(), load.corners.end());
  for (std::size_t n = 0; n + 1 < pieces.ends.size(); ++n)
    pieces.largest = std::max(pieces.largest,
                              std::abs(load.factor(0.5 * (pieces.ends[n] + pieces.ends[n + 1]))));
  return pieces;
}

/// Returns how much a load's factor changes in a piece; if it is constant there, by how much the
/// piece stands out from what is before and after it.
double change_in(const Load& load, double from, double to) {
  const double edge = 1e-3 * (to - from);
  const double before = load.factor(from - edge), after = load.factor(to + edge);
  const auto inside = {load.factor(from + edge), load.factor(0.5 * (from + to)),
                       load.factor(to - edge)};
  const auto [least, most] = std::minmax(inside);
  return std::max(most - least, std::min(std::abs(most - before), std::abs(most - after)));
}

ShortPiece shortest(const Load& load, const Pieces& pieces, const PlannedStage& stage) {
  constexpr double enough_steps = 2, round_off = 1e-6, fraction = 0.1;
  const double step = stage.plan.time_step, nearby = round_off * step;
  const double largest = std::max(std::abs(load.factor(stage.plan.end_time)), pieces.largest);
  ShortPiece shortest{0, enough_steps * step * (1 - round_off), false};
  const auto first = std::lower_bound(pieces.ends.begin() + 1, pieces.ends.end(), stage.start_time);
  for (auto end = first; end != pieces.ends.end() && *(end - 1) <= stage.plan.end_time; ++end) {
    const double from = *(end - 1), to = *end, length = to - from;
    if (!(length > nearby) || !(length < (1 - round_off) * (shortest.to - shortest.from))) continue;
    if (change_in(load, from, to) > fraction * largest) shortest = {from, to, true};
  }
  return shortest;
}

/// Returns a time at which a load's mean over a step differs from the mean of its two halves: the
/// load then changes too fast for its quadrature points. Tries at most about `most_steps` steps of
/// the stage; returns nothing if all agree.
std::optional<double> too_fast_at(const Load& load, const PlannedStage& stage,
                                  std::uint64_t most_steps) {
  constexpr double fraction = 1e-3;
  const double step = stage.plan.time_step;
  const std::uint64_t stride = std::max<std::uint64_t>(1, stage.plan.steps / most_steps);
  double largest = 0, worst = 0, at = 0;
  for (std::uint64_t n = 0; n < stage.plan.steps; n += stride) {
    const double from = stage.start_time + static_cast<double>(n) * step,
                 middle = from + 0.5 * step, to = from + step;
    const double whole = load.mean(from, to),
                 halves = 0.5 * (load.mean(from, middle) + load.mean(middle, to));
    largest = std::max({largest, std::abs(whole), std::abs(halves)});
    if (!(std::abs(whole - halves) > worst)) continue;
    worst = std::abs(whole - halves);
    at = from;
  }
  return worst > fraction * largest ? std::optional(at) : std::nullopt;
}

/// Returns the time of a jump of a load's factor within (from, to), which holds no corner; nothing
/// if there is none. Halves the interval towards the larger difference: that of a smooth function
/// shrinks, a jump stays.
std::optional<double> jump_between(const Load& load, double from, double to, double least) {
  double first = load.factor(from), last = load.factor(to);
  const double whole = std::abs(last - first);
  if (!(whole > least)) return std::nullopt;
  constexpr double shrunk = 0.3, narrow = 1e-6;
  const double width = narrow * (to - from);
  while (to - from > width) {
    const double middle = 0.5 * (from + to), at_middle = load.factor(middle);
    if (!(middle > from && middle < to)) break;
    const bool is_earlier = std::abs(at_middle - first) > std::abs(last - at_middle);
    (is_earlier ? to : from) = middle;
    (is_earlier ? last : first) = at_middle;
    if (!(std::abs(last - first) > shrunk * whole)) return std::nullopt;
  }
  return to;
}

/// Returns the time of the first jump of a load's factor, away from its corners, between the start
/// and the end of the run; nothing if there is none. Looks between samples, a few a step at most.
std::optional<double> jump_of(const Load& load, double step, double end, std::uint64_t most_steps) {
  constexpr double fraction = 1e-3, samples_a_step = 4, beside_a_corner = 1e-6;
  const double samples = samples_a_step *
                         std::min(std::ceil(end / step), static_cast<double>(most_steps)),
               apart = end / samples, gap = beside_a_corner * apart;
  double largest = 0;
  for (double n = 0; n < samples; ++n)
    largest = std::max(largest, std::abs(load.factor((n + 0.5) * apart)));
  auto corner = load.corners.begin();
  double from = gap;
  for (double n = 1; n <= samples; ++n) {
    const double to = n * apart;
    for (; corner != load.corners.end() && *corner <= to + gap; ++corner) {
      if (*corner - gap > from)
        if (const auto at = jump_between(load, from, *corner - gap, fraction * largest)) return at;
      from = std::max(from, *corner + gap);
    }
    if (!(to > from)) continue;
    if (const auto at = jump_between(load, from, to, fraction * largest)) return at;
    from = to;
  }
  return std::nullopt;
}

/// Returns the stage with the longest time step, or null if no stage has steps in time.
const PlannedStage* coarsest_of(const Plan& plan) {
  const PlannedStage* coarsest = nullptr;
  for (const PlannedStage& stage : plan.stages)
    if (!stage.plan.at_rest && stage.plan.time_step > 0 &&
        (coarsest == nullptr || stage.plan.time_step > coarsest->plan.time_step))
      coarsest = &stage;
  return coarsest;
}

}  // namespace

void check_resolution(Plan& plan, Faults& faults) {
  constexpr double fewest = 2, good = 20;  // steps per period
  const PlannedStage* coarsest = coarsest_of(plan);
  if (coarsest == nullptr) return;
  const std::uint64_t most_steps =
      std::clamp<std::uint64_t>(200'000 / (1 + plan.model->loads.size()), 16, 4096);
  for (const Load& load : plan.model->loads) {
    const std::string name =
        fmt::format("{} ({})", load.stage->component->type(), load.stage->pointer);
    const double step = coarsest->plan.time_step;
    if (load.frequency > 0) {
      const double steps = 1 / (load.frequency * step);
      if (steps < fewest * (1 - 1e-9))
        faults.add(load.stage->pointer, fmt::format("{:.6g} Hz", load.frequency),
                   fmt::format("at most {:.4g} Hz, half a period a step of {:.4g} s ({}); or a "
                               "time_step of at most {:.4g} s, 20 steps a period",
                               1 / (fewest * step), step, coarsest->stage->pointer,
                               1 / (good * load.frequency)));
      else if (steps < good)
        plan.model->warnings.push_back(
            fmt::format("{}: a period of its {:.4g} Hz is {:.3g} steps of {}; the mean over a step "
                        "takes {:.2g} % off its amplitude. 20 steps a "
                        "period take off 0.4 %: a time_step of {:.4g} s",
                        name, load.frequency, steps, coarsest->stage->pointer,
                        100 * lost_by_mean(steps), 1 / (good * load.frequency)));
    }
    if (const auto jump = jump_of(load, step, plan.end_time(), most_steps))
      plan.model->warnings.push_back(
          fmt::format("{}: at {:.6g} s it jumps, which a mean over a step does not see, so its "
                      "impulse is not exact. It needs corners where it has jumps",
                      name, *jump));
    else if (const auto at = too_fast_at(load, *coarsest, most_steps))
      plan.model->warnings.push_back(
          fmt::format("{}: about {:.4g} s it changes faster than the steps of {}, {:.4g} s, can "
                      "tell, so its impulse is not exact. It needs shorter steps, or "
                      "corners where it has kinks and jumps",
                      name, *at, coarsest->stage->pointer, step));
    const Pieces pieces = pieces_of(load);
    ShortPiece piece;
    for (const PlannedStage& stage : plan.stages) {
      if (stage.plan.at_rest || !(stage.plan.time_step > 0)) continue;
      piece = shortest(load, pieces, stage);
      if (!piece.found) continue;
      plan.model->warnings.push_back(
          fmt::format("{}: from {:.4g} s to {:.4g} s it changes within {:.2g} steps of {}. Its "
                      "impulse is exact, but its shape needs two steps or "
                      "more: a time_step of at most {:.3g} s",
                      name, piece.from, piece.to, (piece.to - piece.from) / stage.plan.time_step,
                      stage.stage->pointer, (piece.to - piece.from) / 2));
      break;
    }
  }
}

}  // namespace hyperlattice
