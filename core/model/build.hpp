// The steps of build_model, and the faults that report what a component refuses.
#pragma once

#include <model/model.hpp>
#include <model/region_index.hpp>
#include <scene/stage_call.hpp>

namespace hyperlattice {

/// Returns a fault of the stage with the sentence of the component that refused.
inline InputError refusal(const Stage& stage, const std::string& sentence) {
  return InputError({{stage.pointer, stage.component->type(),
                      "what the component accepts; it says: " + sentence}});
}

/// Returns the same for a component that refused its options: if the first word of the sentence is
/// the name of an option, the fault is at this option.
InputError objection(const Scene& scene, const Stage& stage, const std::string& sentence);

inline void add_all(Faults& faults, const InputError& error) {
  for (const Fault& fault : error.faults()) faults.add(fault.pointer, fault.value, fault.expected);
}

// The steps, in their order. Each step adds its faults and, where it can, leaves a model that the
// next step can use.

/// Makes the materials and their failure criteria, and assigns a material to each particle.
void add_materials(Model& model, RegionIndex& regions, Faults& faults);

/// Sets the geometry of the neighbours, the springs between all materials, the alarms, and the
/// kernels.
void set_springs(Model& model, Faults& faults);

/// Sets the constants of the damage of materials with a strength surface. Adds a fault for what
/// damage does not know, and for a length that is too small or too large. Needs the laws.
void set_cohesive(Model& model, Faults& faults);
/// Finds the particles near supports, which take no damage.
void set_intact(Model& model);

/// Sets the volumetric energies of the cells. Adds a fault for each material whose K_v this lattice
/// or the body's failure does not allow.
void set_volumetric(Model& model, RegionIndex& regions, Faults& faults);
/// Sets those of a listed body. Adds a fault for each material that cannot have one.
void set_nodal_volumes(Model& model, RegionIndex& regions, Faults& faults);

/// Returns the part of a composite spring that has a material's own springs.
SpringPart part_of(const Model& model, std::uint8_t material, std::uint32_t spring_class,
                   double weight);

/// Appends the springs, masses and alpha springs of each mixture to those of the materials.
void add_mixtures(Model& model);

/// Makes the loads, merged for each particle, with start velocities, corners and body acceleration.
void add_loads(Model& model, RegionIndex& regions, Faults& faults);

/// Shortens the critical step to one that is stable with the loads that answer to the motion.
void limit_step_by_loads(Model& model);

/// Returns the base springs with one end or both among the particles, which must be ascending; each
/// spring once, sorted by a, then b.
std::vector<RestSpring> springs_at(const Model& model, std::span<const Particle> particles);

}  // namespace hyperlattice
