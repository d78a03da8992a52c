// Calls of the law of a spring of the body, of one law or composite. Each function throws
// OutsideError with the name of the material's plugin if a law throws. `cross`: 0 base spring, 1
// cross spring. `kept`: memory of the spring, SpringTable::memory numbers.
#pragma once

#include <model/model.hpp>

namespace hyperlattice {

inline OneSpring one_spring(const SpringProperties& properties, std::size_t cross,
                            double elongation) {
  return {properties.stiffness_of(cross), properties.rest_length_of(cross), elongation,
          properties.constants[cross], nullptr};
}
inline CompositeSpring::Spring composite_spring(const SpringProperties& properties,
                                                std::size_t cross, double elongation) {
  return {cross, properties.factor, properties.rest_length_of(cross), elongation};
}

/// Sets the start values of a new spring's memory, which is all zero.
inline void start_memory_of(const Model& model, const SpringProperties& properties,
                            std::size_t cross, const SpringIdentity& identity, double* kept) {
  if (properties.composite != nullptr) return properties.composite->start(identity, cross, kept);
  start_spring(model.springs.laws[properties.law], properties.constants[cross], identity, kept);
}

/// Advances a spring by a step of `time_step` seconds to an elongation, m.
inline CompositeAnswer take_spring(const Model& model, const SpringProperties& properties,
                                   std::size_t cross, double elongation, double time_step,
                                   double* kept) {
  if (properties.composite != nullptr)
    return properties.composite->take(composite_spring(properties, cross, elongation), time_step,
                                      kept);
  const Law& law = model.springs.laws[properties.law];
  const SpringAnswer answer =
      take_spring(law, one_spring(properties, cross, elongation), time_step, kept);
  return {answer.force, answer.energy, law.kernels.softens ? 0 : answer.dissipated,
          law.kernels.softens ? answer.dissipated : 0, answer.integrity};
}

/// Returns the present answer of a spring without a step.
inline CompositeAnswer ask_spring(const Model& model, const SpringProperties& properties,
                                  std::size_t cross, double elongation, const double* kept) {
  if (properties.composite != nullptr)
    return properties.composite->present(composite_spring(properties, cross, elongation), kept);
  OneSpring spring = one_spring(properties, cross, elongation);
  spring.memory = kept;
  const SpringAnswer answer = ask_spring(model.springs.laws[properties.law], spring);
  return {answer.force, answer.energy, 0, 0, answer.integrity};
}

/// Calls visit(law, spring, weight) for each part of a spring in its present state; a spring of one
/// law is one part of the weight 1.
template <class Visit>
void for_parts(const Model& model, const SpringProperties& properties, std::size_t cross,
               double elongation, const double* kept, const Visit& visit) {
  if (properties.composite != nullptr)
    return properties.composite->for_parts(composite_spring(properties, cross, elongation), kept,
                                           visit);
  OneSpring spring = one_spring(properties, cross, elongation);
  spring.memory = kept;
  visit(model.springs.laws[properties.law], spring, 1.0);
}

/// Where the ends a and b of a spring are: the displacement of b less that of a, and heights, m.
struct SpringMotion {
  Vec3 apart;
  double height_a = 0, height_b = 0;
};

/// Force over length, N/m, and energy, J, of a whole base spring with its cross springs.
struct SpringPull {
  double pull = 0, energy = 0;
};

/// Returns the pull of a spring in its present motion. A law with a memory gives the force that it
/// has after a step of `time_step` seconds to this motion. `memory(cross)` returns a copy of what
/// the laws keep, in a container with data(). `remains`: what damage leaves of a cross spring, and
/// of a base spring that is stretched.
template <class Memory>
SpringPull pull_of(const Model& model, const SpringProperties& properties,
                   const SpringMotion& motion, double time_step, const Memory& memory,
                   double remains = 1) {
  const std::size_t kinds = model.springs.choice.membrane == KernelChoice::Membrane::none ? 1 : 2;
  SpringPull sum;
  for (std::size_t cross = 0; cross < kinds; ++cross) {
    const double rise = cross == 0 ? motion.height_b - motion.height_a
                                   : motion.height_b + motion.height_a,
                 growth = properties.growth(cross, motion.apart, rise,
                                            model.body.grid.membrane_distance);
    auto kept = memory(cross);
    const CompositeAnswer answer = take_spring(
        model, properties, cross, properties.elongation(cross, growth), time_step, kept.data());
    const double factor = cross == 1 || growth > 0 ? remains : 1;
    sum.pull += factor * answer.force / properties.length(cross, growth);
    sum.energy += factor * answer.stored;
  }
  return sum;
}

}  // namespace hyperlattice
