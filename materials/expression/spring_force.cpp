#include "spring_force.hpp"

#include "expression.hpp"

#include <quantities/derivative.hpp>
#include <quantities/lanes.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <map>
#include <mutex>
#include <stdexcept>

namespace hyperlattice::spring_expression {

namespace {

constexpr std::size_t most_kept = 10'000;

using Numbers = std::array<double, input_count>;

Numbers numbers_of(const SpringState& spring) {
  return inputs_of(spring.stiffness, spring.rest_length, spring.elongation, spring.rate);
}

SpringState at_rest(SpringState spring) {
  spring.rate = 0;
  return spring;
}

/// Four numbers.
struct Four {
  double lane[4];

  Four() = default;
  explicit Four(double all) : Four(all, all, all, all) {}
  Four(double a, double b, double c, double d) : lane{a, b, c, d} {}

  template <class Operation>
  static Four of(const Operation& operation) {
    return {operation(0), operation(1), operation(2), operation(3)};
  }
  friend Four operator+(const Four& a, const Four& b) {
    return of([&](std::size_t n) { return a.lane[n] + b.lane[n]; });
  }
  friend Four operator-(const Four& a, const Four& b) {
    return of([&](std::size_t n) { return a.lane[n] - b.lane[n]; });
  }
  friend Four operator*(const Four& a, const Four& b) {
    return of([&](std::size_t n) { return a.lane[n] * b.lane[n]; });
  }
  friend Four operator/(const Four& a, const Four& b) {
    return of([&](std::size_t n) { return a.lane[n] / b.lane[n]; });
  }
};

/// The registered expressions. Entries do not move, so that readers need no lock.
std::array<std::atomic<const SpringForce*>, most_kept> all_kept;

}  // namespace

std::vector<ExpressionName> input_names() {
  return {{"elongation", {1}, {}},       {"strain", {}, {}},
          {"rate", {1, 0, -1}, {}},      {"strain_rate", {0, 0, -1}, {}},
          {"stiffness", {0, 1, -2}, {}}, {"rest_length", {1}, {}}};
}

double SpringForce::force_at(const SpringState& spring) const { return force(numbers_of(spring)); }

double SpringForce::tangent_at(const SpringState& spring) const {
  Numbers direction{};
  direction[elongation] = 1;
  direction[strain] = 1 / spring.rest_length;
  return derivative(force, numbers_of(spring), direction);
}

double SpringForce::viscosity_at(const SpringState& spring) const {
  Numbers direction{};
  direction[rate] = 1;
  direction[strain_rate] = 1 / spring.rest_length;
  return derivative(force, numbers_of(spring), direction);
}

// Panels of Gauss with three points, which are exact for polynomials up to the fifth power. A step
// in time is far shorter than a panel. The fourth lane has the force at
// the end.
SpringForce::Advance SpringForce::advance(const SpringState& spring, double from) const {
  constexpr double widest = 1e-3, most_panels = 10'000;  // of the rest length
  constexpr double outer = 0.774596669241483377, weight_outer = 5.0 / 18, weight_middle = 4.0 / 9;
  const double to = spring.elongation;
  Advance result;
  const auto force_only = [&](double energy_change) {
    return Advance{energy_change, force_at(spring)};
  };
  if (to == from) return force_only(0);
  if (energy) {
    SpringState before = spring;
    before.elongation = from;
    return force_only((*energy)(numbers_of(at_rest(spring))) -
                      (*energy)(numbers_of(at_rest(before))));
  }
  const double panels = std::clamp(std::ceil(std::abs(to - from) / (widest * spring.rest_length)),
                                   1.0, most_panels),
               width = (to - from) / panels;
  for (double n = 0; n < panels; ++n) {
    const double middle = from + (n + 0.5) * width, reach = outer * width / 2;
    const Four points{middle, middle - reach, middle + reach, to}, rates{0, 0, 0, spring.rate};
    const std::array<Four, input_count> inputs =
        inputs_of(Four(spring.stiffness), Four(spring.rest_length), points, rates);
    const Four forces = values_of<Four>(force, inputs);
    result.energy +=
        width * (weight_middle * forces.lane[0] + weight_outer * (forces.lane[1] + forces.lane[2]));
    result.force = forces.lane[3];
  }
  return result;
}

std::size_t keep(const std::string& text, const SpringForce& force) {
  static std::mutex mutex;
  static auto& numbers = *new std::map<std::string, std::size_t>;
  const std::lock_guard lock(mutex);
  if (const auto found = numbers.find(text); found != numbers.end()) return found->second;
  const std::size_t number = numbers.size();
  if (number == most_kept) throw std::runtime_error("too many different expressions of forces");
  all_kept[number] = new SpringForce(force);
  numbers.emplace(text, number);
  return number;
}

const SpringForce& kept(double number) {
  return *all_kept[static_cast<std::size_t>(number)].load(std::memory_order_acquire);
}

}  // namespace hyperlattice::spring_expression

using hyperlattice::SpringState;
using hyperlattice::spring_expression::kept;

void ExpressionLaw::update(const SpringState& s, const Constants& c, Memory& m) {
  const auto advance = kept(c.number).advance(s, m.at);
  m.energy += advance.energy;
  m.at = s.elongation;
  m.force = advance.force;
}
double ExpressionLaw::force(const SpringState&, const Constants&, const Memory& m) {
  return m.force;
}
double ExpressionLaw::energy(const SpringState& s, const Constants& c, const Memory& m) {
  return s.elongation == m.at ? m.energy : m.energy + kept(c.number).energy_since(s, m.at);
}
double ExpressionLaw::tangent(const SpringState& s, const Constants& c, const Memory&) {
  return kept(c.number).tangent_at(s);
}
