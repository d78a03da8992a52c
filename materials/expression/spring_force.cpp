#include "spring_force.hpp"

#include "expression.hpp"

#include <quantities/derivative.hpp>

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

Numbers inputs_of(const SpringState& spring) {
  return {spring.elongation, spring.elongation / spring.rest_length,
          spring.rate,       spring.rate / spring.rest_length,
          spring.stiffness,  spring.rest_length};
}

/// The registered expressions. Entries do not move, so that readers need no lock.
std::array<std::atomic<const SpringForce*>, most_kept> all_kept;

}  // namespace

std::vector<ExpressionName> input_names() {
  return {{"elongation", {1}, {}},       {"strain", {}, {}},
          {"rate", {1, 0, -1}, {}},      {"strain_rate", {0, 0, -1}, {}},
          {"stiffness", {0, 1, -2}, {}}, {"rest_length", {1}, {}}};
}

double SpringForce::force_at(const SpringState& spring) const { return force(inputs_of(spring)); }

double SpringForce::tangent_at(const SpringState& spring) const {
  Numbers direction{};
  direction[elongation] = 1;
  direction[strain] = 1 / spring.rest_length;
  return derivative(force, inputs_of(spring), direction);
}

double SpringForce::viscosity_at(const SpringState& spring) const {
  Numbers direction{};
  direction[rate] = 1;
  direction[strain_rate] = 1 / spring.rest_length;
  return derivative(force, inputs_of(spring), direction);
}

double SpringForce::energy_since(const SpringState& spring, double from) const {
  SpringState at = spring;
  at.rate = 0;
  const double to = spring.elongation;
  const auto value = [&](const Compiled& expression, double u) {
    at.elongation = u;
    return expression(inputs_of(at));
  };
  if (to == from) return 0;
  if (energy) return value(*energy, to) - value(*energy, from);
  // Panels of Gauss with three points, which are exact for polynomials up to the fifth power. A
  // step in time is far shorter than a panel.
  constexpr double widest = 1e-3, most_panels = 10'000;  // of the rest length
  constexpr double outer = 0.774596669241483377, weight_outer = 5.0 / 18, weight_middle = 4.0 / 9;
  const double panels = std::clamp(std::ceil(std::abs(to - from) / (widest * spring.rest_length)),
                                   1.0, most_panels),
               width = (to - from) / panels;
  double sum = 0;
  for (double n = 0.5; n < panels; ++n) {
    const double middle = from + n * width, reach = outer * width / 2;
    sum += width * (weight_middle * value(force, middle) +
                    weight_outer * (value(force, middle - reach) + value(force, middle + reach)));
  }
  return sum;
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
  m.energy += kept(c.number).energy_since(s, m.at);
  m.at = s.elongation;
}
double ExpressionLaw::force(const SpringState& s, const Constants& c, const Memory&) {
  return kept(c.number).force_at(s);
}
double ExpressionLaw::energy(const SpringState& s, const Constants& c, const Memory& m) {
  return m.energy + kept(c.number).energy_since(s, m.at);
}
double ExpressionLaw::tangent(const SpringState& s, const Constants& c, const Memory&) {
  return kept(c.number).tangent_at(s);
}
