// The model of a scene: particles, springs, masses and loads. It does not change during a run.
#pragma once

#include <model/cohesive.hpp>
#include <model/load.hpp>
#include <model/material.hpp>
#include <model/particle_kinds.hpp>
#include <model/spring_properties.hpp>
#include <model/spring_table.hpp>
#include <model/step_limit.hpp>
#include <model/volumetric.hpp>
#include <scene/scene.hpp>

#include <memory>
#include <string>
#include <vector>

namespace hyperlattice {

class NodalVolumes;

struct Model {
  const Scene* scene = nullptr;
  Body body;
  std::vector<Material> materials;
  ParticleKinds kinds;
  SpringTable springs;
  Volumetric volumetric;
  CohesiveMaterials cohesive;
  /// 1 for each particle that takes no damage because it is near a support; empty if none is.
  std::vector<std::uint8_t> intact;
  LoadSet loads;
  StepLimit step_limit;
  int degrees_of_freedom = 3;         ///< of a particle; 4 with a free membrane
  std::vector<std::string> warnings;  ///< about settings that are allowed but not sound
  /// The volumetric energies of a listed body; null if no material has one.
  std::shared_ptr<const NodalVolumes> nodal_volumes;

  /// Returns the mass of a particle, kg.
  double mass(Particle particle) const {
    return body.share(particle) * kinds.masses[kinds.of(particle)];
  }
  /// Returns the properties of the spring from a to b. `neighbour`: in a structured body the index
  /// in SpringTable::neighbours, in a listed body the index in its list of springs.
  SpringProperties spring_properties(Particle a, Particle b, std::uint32_t neighbour) const;
  /// Returns the materials of the spring from a to b: those of its cells in a body of cells of
  /// several materials, else those of its ends.
  SpringMaterials materials_of(Particle a, Particle b, std::uint32_t neighbour) const;
  /// Returns what the failure criterion of `material` knows of a spring. A spring of several
  /// materials consists of one part for each material; the criterion is asked about a whole spring
  /// of its material with the force of this part, see elongation_in().
  SpringFacts facts(const SpringProperties& properties, std::uint8_t material) const {
    const double stiffness =
        properties.factor * springs.spring(material, material, properties.spring_class).stiffness;
    return {properties.rest_length, stiffness, body.grid.spacing, properties.spring_class,
            springs.crossings};
  }
  /// Returns the elongation, m, of a whole spring of `material` with the force of this material's
  /// part of a spring. `kept`: memory of the spring; used by composite springs.
  double elongation_in(std::uint8_t material, const SpringProperties& properties, double elongation,
                       const double* kept) const;
  /// Returns the elongation, m, of a whole spring of `material`, with the rest length of a spring,
  /// below which this material's criterion does not break it; infinite if it has none.
  double own_alarm(std::uint8_t material, const SpringProperties& properties) const;
  /// Returns the elongation, m, below which no criterion breaks the spring from a to b; infinite if
  /// none can.
  double alarm(Particle a, Particle b, std::uint32_t neighbour,
               const SpringProperties& properties) const;
};

/// Builds the model of a scene. Throws InputError for errors that only the built body shows (an
/// empty region, two loads on one degree of freedom, a Poisson ratio out of a lattice's reach,
/// particles without material).
std::unique_ptr<Model> build_model(const Scene& scene);

}  // namespace hyperlattice
