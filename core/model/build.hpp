// The steps of build_model, and how a component's refusal becomes a fault.
#pragma once

#include <model/model.hpp>
#include <model/region_index.hpp>
#include <scene/stage_call.hpp>

namespace hyperlattice {

/// What a component said when it refused, as a fault of its stage.
inline InputError refusal(const Stage& stage, const std::string& sentence) {
  return InputError({{stage.pointer, stage.component->type(),
                      "what the component accepts; it says: " + sentence}});
}

/// The same of an objection to how it was configured: a fault of the option that the sentence's
/// first word names, if it names one.
InputError objection(const Scene& scene, const Stage& stage, const std::string& sentence);

inline void add_all(Faults& faults, const InputError& error) {
  for (const Fault& fault : error.faults()) faults.add(fault.pointer, fault.value, fault.expected);
}

// The steps, in their order. Each adds its faults and leaves the model usable for the next where it
// can.

/// Makes the materials and their failure criteria, and says which particle is of which.
void add_materials(Model& model, RegionIndex& regions, Faults& faults);

/// Neighbour geometry, the springs between all materials, alarms, and which kernel is needed.
void set_springs(Model& model, Faults& faults);

/// Springs, masses and alpha springs of each mixture, behind those of the materials.
void add_mixtures(Model& model);

/// Loads, merged for each particle, with start velocities, corners and body acceleration.
void add_loads(Model& model, RegionIndex& regions, Faults& faults);

/// Shortens the critical step to one that is stable with what the loads answer.
void limit_step_by_loads(Model& model);

/// The base springs with one end or both among the particles, which ascend; each once, by a, then
/// b.
std::vector<RestSpring> springs_at(const Model& model, std::span<const Particle> particles);

}  // namespace hyperlattice
