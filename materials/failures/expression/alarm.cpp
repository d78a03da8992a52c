#include "alarm.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <numeric>

namespace hyperlattice::spring_condition {

namespace {

// Products and sums round the same way in both; powers and other functions need not be monotone in
// the last bits.
constexpr double margin_of_scaling = 1e-15, margin_of_functions = 1e-12;

using Inputs = std::array<Interval, input_count>;

/// Returns the inputs of any spring at any rate and time.
Inputs any_spring() {
  Inputs inputs{};
  for (const Input positive : {time, rest_length, stiffness, spacing}) inputs[positive].low = 0;
  return inputs;
}

/// Returns a number's place among all doubles, so that neighbours have neighbouring places.
std::int64_t place_of(double number) {
  const auto bits = std::bit_cast<std::int64_t>(number);
  return bits < 0 ? std::numeric_limits<std::int64_t>::min() - bits : bits;
}
double number_at(std::int64_t place) {
  return std::bit_cast<double>(place < 0 ? std::numeric_limits<std::int64_t>::min() - place
                                         : place);
}

std::uint64_t new_number() {
  static std::atomic<std::uint64_t> last = 0;
  return ++last;
}

}  // namespace

Alarm::Alarm(const Compiled& condition) : condition_(condition), number_(new_number()) {
  is_of_strain_ = true;
  for (const Input other : {elongation, force, rest_length, stiffness, spacing})
    is_of_strain_ = is_of_strain_ && !condition.uses(other);
  margin_ = margin_of_scaling;
  for (const Instruction& one : condition.code())
    if (one.operation == Operation::power || one.operation == Operation::call)
      margin_ = margin_of_functions;
  if (!is_of_strain_) return;
  strain_ = search(-1, [](double x) {
    Inputs inputs = any_spring();
    inputs[strain] = {-1, x};
    return inputs;
  });
}

template <class SpringAt>
double Alarm::search(double lowest, const SpringAt& spring) const {
  const auto is_false = [&](double x) { return bounds(condition_, spring(x)).high == 0; };
  if (is_false(infinity)) return infinity;
  if (!is_false(lowest)) return lowest;
  std::int64_t good = place_of(lowest), bad = place_of(infinity);
  while (good + 1 < bad) {
    const std::int64_t middle = std::midpoint(good, bad);
    (is_false(number_at(middle)) ? good : bad) = middle;
  }
  const double found = number_at(good);
  return std::max(lowest, found - margin_ * std::abs(found));
}

double Alarm::of(const SpringFacts& spring) const {
  if (is_of_strain_) return strain_ * spring.rest_length;
  // Rows of a lattice ask for the same few springs many times.
  struct Known {
    std::uint64_t number = 0;
    double rest_length = 0, stiffness = 0, spacing = 0, alarm = 0;
  };
  constexpr std::size_t most_known = 64;
  thread_local std::array<Known, most_known> all_known;
  const std::uint64_t mixed = number_ + 3 * std::bit_cast<std::uint64_t>(spring.rest_length) +
                              7 * std::bit_cast<std::uint64_t>(spring.stiffness);
  Known& known = all_known[(mixed * 0x9E3779B97F4A7C15U) >> 58U];
  if (known.number != number_ || known.rest_length != spring.rest_length ||
      known.stiffness != spring.stiffness || known.spacing != spring.spacing)
    known = {number_, spring.rest_length, spring.stiffness, spring.spacing, of_elongation(spring)};
  return known.alarm;
}

double Alarm::of_elongation(const SpringFacts& facts) const {
  return search(-facts.rest_length, [&](double x) {
    Inputs inputs = any_spring();
    inputs[elongation] = {-facts.rest_length, x};
    inputs[strain] = {-1, x / facts.rest_length};
    inputs[force] = {facts.stiffness * -facts.rest_length, facts.stiffness * x};
    inputs[rest_length] = {facts.rest_length, facts.rest_length};
    inputs[stiffness] = {facts.stiffness, facts.stiffness};
    inputs[spacing] = {facts.spacing, facts.spacing};
    return inputs;
  });
}

}  // namespace hyperlattice::spring_condition
