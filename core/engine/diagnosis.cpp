#include <engine/diagnosis.hpp>
#include <model/critical_step.hpp>
#include <model/spring_calls.hpp>
#include <state/present_springs.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace hyperlattice {

namespace {

/// Returns the change of force over the change of elongation, N/m. Laws with a memory count by
/// their stiffness.
double tangent_of(const Model& model, const SpringProperties& properties, double elongation) {
  if (model.springs.memory > 0 || properties.composite != nullptr) return properties.stiffness;
  const double step = 1e-5 * properties.rest_length;
  const auto force = [&](double at) { return ask_spring(model, properties, 0, at, nullptr).force; };
  return (force(elongation + step) - force(elongation - step)) / (2 * step);
}

/// Adds the stiffness of a spring: `tangent` along the vector between its ends and `pull`, its
/// force over its length, across it, N/m. A spring that pushes is counted as one without force.
void add(StiffnessBound& bound, Vec3 vector, double tangent, double pull) {
  const auto add_along = [&](Vec3 direction, double stiffness) {
    NeighbourGeometry neighbour;
    neighbour.rest = direction;
    neighbour.rest_length = norm(direction);
    SpringConstants spring;
    spring.stiffness = stiffness;
    bound.add(neighbour, 1, spring, 0, KernelChoice::Membrane::none);
  };
  add_along(vector, tangent);
  if (!(pull > 0)) return;
  const Vec3 other = std::abs(vector.x) < 0.7 * norm(vector) ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 across = cross(vector, other);
  add_along(across, pull);
  add_along(cross(vector, across), pull);
}

/// What the springs that start at a particle say.
struct FromParticle {
  SpringExtremes::Extreme longest{1}, shortest{1}, closing;
};

std::string place_of(const Model& model, Particle particle) {
  const Vec3 x = model.body.position(particle);
  return fmt::format("({:.4g}, {:.4g}, {:.4g}) m", x.x, x.y, x.z);
}

}  // namespace

SpringExtremes spring_extremes(const Model& model, const Simulation& simulation, double time_step) {
  SpringExtremes state;
  const PresentSprings springs(model, simulation);
  std::vector<double> velocity;
  simulation.velocities(velocity);
  for (const std::span<const double> field :
       {springs.displacements(), std::span<const double>(velocity)})
    for (const double number : field)
      if (!std::isfinite(number)) return state;
  const auto speed = [&](Particle p) {
    return Vec3{velocity[3 * p], velocity[3 * p + 1], velocity[3 * p + 2]};
  };
  std::vector<StiffnessBound> now(model.body.particles), rest(model.body.particles);
  std::vector<FromParticle> from(model.body.particles);
  springs.for_springs(Asked::forces, [&](const PresentSpring& spring) {
    const Vec3 vector = spring.rest + spring.apart;
    const double length = norm(vector), rest_length = norm(spring.rest);
    FromParticle& first = from[spring.a];
    const auto take = [&](SpringExtremes::Extreme& extreme, double value, bool larger) {
      if (larger) extreme = {value, spring.a, spring.b};
    };
    take(first.longest, length / rest_length, length / rest_length > first.longest.value);
    take(first.shortest, length / rest_length, length / rest_length < first.shortest.value);
    if (!(length > 0)) return;
    const double closing =
        -dot(speed(spring.b) - speed(spring.a), vector) / (length * length) * time_step;
    take(first.closing, closing, closing > first.closing.value);
    const SpringProperties properties =
        model.spring_properties(spring.a, spring.b, spring.neighbour);
    for (const Particle end : {spring.a, spring.b}) {
      add(now[end], vector, spring.share * tangent_of(model, properties, length - rest_length),
          spring.share * spring.pull);
      add(rest[end], spring.rest, spring.share * properties.stiffness, 0);
    }
  });
  double most_now = 0, most_at_rest = 0;
  for (Particle p = 0; p < from.size(); ++p) {
    if (from[p].longest.value > state.longest.value) state.longest = from[p].longest;
    if (from[p].shortest.value < state.shortest.value) state.shortest = from[p].shortest;
    if (from[p].closing.value > state.closing.value) state.closing = from[p].closing;
    const double mass = simulation.inertia(p), square = now[p].value() / mass;
    if (square > most_now) {
      most_now = square;
      state.stiffest = p;
    }
    most_at_rest = std::max(most_at_rest, rest[p].value() / mass);
  }
  if (most_now > 0 && most_at_rest > 0) state.critical = std::sqrt(most_at_rest / most_now);
  return state;
}

std::string likely_cause(const Model& model, const SpringExtremes& state, double time_step,
                         double critical) {
  constexpr double crosses = 0.5, far = 1.5, folded = 0.5;
  const double present = state.critical * critical;
  const auto ends = [&](const SpringExtremes::Extreme& extreme) {
    return fmt::format("at {} and {}", place_of(model, extreme.a), place_of(model, extreme.b));
  };
  // Steps beyond the critical one also make particles fast.
  if (time_step < critical && time_step > present)
    return fmt::format(
        "Likely cause: springs that stiffen or are stretched have shortened the critical step to "
        "about {:.3g} s, at {}. Take a time_step of at most {:.3g} s or a `safety` of {:.2g}.",
        present, place_of(model, state.stiffest), 0.9 * present, 0.9 * state.critical);
  if (state.closing.value > crosses)
    return fmt::format(
        "Likely cause: particles pass through each other: those {} come nearer by {:.3g} of their "
        "distance in one step. Take a shorter time_step, a smaller or slower load, or a failure "
        "law.",
        ends(state.closing), state.closing.value);
  if (state.longest.value > far)
    return fmt::format(
        "Likely cause: springs are stretched to {:.3g} times their length, {}: loads beyond what "
        "the law is made for. Check loads and units, or give the material a failure law.",
        state.longest.value, ends(state.longest));
  if (state.shortest.value < folded)
    return fmt::format(
        "Likely cause: springs are compressed to {:.3g} of their length, {}: cells may have "
        "folded. "
        "Check loads and units, or take a shorter time_step.",
        state.shortest.value, ends(state.shortest));
  return {};
}

}  // namespace hyperlattice
