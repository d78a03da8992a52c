#include "spring_force.hpp"

#include "expression.hpp"

#include <quantities/degree.hpp>
#include <quantities/derivative.hpp>
#include <quantities/lanes.hpp>

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <stdexcept>

namespace hyperlattice::spring_expression {

namespace {

constexpr std::size_t most_kept = 10'000;

using Numbers = std::array<double, input_count>;

Numbers numbers_of(const SpringState& spring) {
  return inputs_of(spring.stiffness, spring.rest_length, 1 / spring.rest_length, spring.elongation,
                   spring.rate);
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

/// Returns whether a force is a polynomial of the elongation, for any rate, that GaussRule
/// integrates without an error.
bool is_low_polynomial(const Compiled& force) {
  std::array<bool, input_count> moves{};
  moves[elongation] = moves[strain] = true;
  const std::optional<int> degree = degree_of(force, moves);
  return degree && *degree <= GaussRule::exact_degree;
}

SpringForce::SpringForce(Compiled force_expression, std::optional<Compiled> energy_expression)
    : force(std::move(force_expression)),
      energy(std::move(energy_expression)),
      has_strain(force.uses(strain) || force.uses(strain_rate)),
      has_exact_rule(!energy && is_low_polynomial(force)) {}

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

SpringForce::Advance SpringForce::advance(const SpringState& spring, double from) const {
  constexpr double short_way = 1e-3;  // of the rest length
  const double way = spring.elongation - from;
  if (way == 0) return {0, force_at(spring)};
  if (energy) {
    SpringState before = spring;
    before.elongation = from;
    return {(*energy)(numbers_of(at_rest(spring))) - (*energy)(numbers_of(at_rest(before))),
            force_at(spring)};
  }
  if (has_exact_rule || std::abs(way) <= short_way * spring.rest_length)
    return advance_by_rule(spring, from);
  return {integral(spring, from), force_at(spring)};
}

/// The fourth lane has the force at the end.
SpringForce::Advance SpringForce::advance_by_rule(const SpringState& spring, double from) const {
  const double to = spring.elongation, way = to - from, middle = from + way / 2,
               reach = GaussRule::outer * way / 2;
  const std::array<Four, input_count> inputs =
      inputs_of(Four(spring.stiffness), Four(spring.rest_length), Four(1 / spring.rest_length),
                Four(middle, middle - reach, middle + reach, to), Four(0, 0, 0, spring.rate));
  const auto [at_middle, below, above, at_end] = values_of<Four>(force, inputs).lane;
  return {way * (GaussRule::weight_middle * at_middle + GaussRule::weight_outer * (below + above)),
          at_end};
}

/// Gauss and Kronrod's rule of 15 points, in halves where the force bends. Not a number if an end
/// is none, as it may be in the lanes of missing springs.
double SpringForce::integral(const SpringState& spring, double from) const {
  constexpr unsigned most_halvings = 15;
  constexpr double tolerance = 1e-10;
  const double way = spring.elongation - from;
  if (!std::isfinite(way)) return std::numeric_limits<double>::quiet_NaN();
  SpringState at = at_rest(spring);
  // Over parts of the way, since the rule does not scale its error with the length of the interval.
  return way * boost::math::quadrature::gauss_kronrod<double, 15>::integrate(
                   [&](double part) {
                     at.elongation = from + part * way;
                     return force_at(at);
                   },
                   0, 1, most_halvings, tolerance);
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
