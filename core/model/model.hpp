// The model: particles, springs, masses, loads; everything that stays the same during a run. Built
// from a scene, then immutable.
#pragma once

#include <model/mixtures.hpp>
#include <scene/scene.hpp>

#include <hyperlattice/failure.hpp>
#include <hyperlattice/kernel_request.hpp>
#include <hyperlattice/load.hpp>
#include <hyperlattice/material.hpp>

#include <memory>
#include <string>
#include <vector>

namespace hyperlattice {

/// Lets its plugin destroy a component; the last line of the program names the plugin if that
/// crashes.
struct Destroy {
  const Component* of = nullptr;
  void operator()(void* made) const;
};
/// A component made from its stage; destroyed by the plugin that made it.
using ComponentPointer = std::unique_ptr<void, Destroy>;
ComponentPointer make_component(
    const Stage& stage);  ///< InputError at the stage's pointer if it refuses its options

struct Material {
  const Stage* stage = nullptr;
  ComponentPointer component;
  MaterialConstants constants;
  double mass = 0;                       ///< of a whole particle, kg
  double critical_time_step = 0;         ///< of the infinite lattice of this material, s
  const Stage* failure_stage = nullptr;  ///< null: unbreakable
  ComponentPointer failure;
};

/// A load's contributions, as it declared them.
struct LoadedParticle {
  Particle particle = 0;
  Vec3 force;                      ///< amplitude, N
  Axes displaced = 0, driven = 0;  ///< axes with a prescribed displacement, velocity
  Vec3 displacement, velocity;     ///< amplitudes
};
struct WatchedParticle {
  Particle particle = 0;
  bool answered = true;  ///< false: the load only looks at it
  LoadStiffnessBound reaction;
};
struct Load {
  const Stage* stage = nullptr;
  ComponentPointer component;
  std::vector<LoadedParticle> particles;  ///< ascending, each once
  std::vector<WatchedParticle> watched;   ///< as the load named them
  std::vector<double> corners;  ///< s, ascending, each once: where the factor has a kink or jump
  double frequency = 0;  ///< Hz, the highest at which the factor oscillates; 0: none declared
  Vec3 acceleration;
  // Each throws OutsideError if the load throws. What is no number is found by the run.
  double factor(double time) const;
  double after(double time) const;  ///< the factor, at one of the load's corners that just after
                                    ///< it: where the load has jumped
  double mean(double from, double to)
      const;  ///< of the factor in [from, to]; exact between corners for polynomials up to degree 9
  double integral(double from,
                  double to) const;  ///< s, of the factor over any length of time, to about 1e-12
  /// Value and slope, 1/s, of the factor just after `time`, or just before if `reach` is negative;
  /// seen over |reach| seconds, up to a corner.
  struct Limit {
    double value = 0, slope = 0;
  };
  Limit limit(double time, double reach) const;
  bool prepares() const {
    return !watched.empty() && stage->functions<LoadFunctions>().prepare != nullptr;
  }
  void prepare(const WatchedMotion& motion) const;
  Vec3 answer(const WatchedMotion& motion,
              std::size_t n) const;  ///< force on the n-th watched particle, N
};

/// One base spring with the cross springs beside it, wherever it stands.
struct SpringProperties {
  Vec3 rest;                     ///< from its first end to the other, metres
  double rest_length = 0;        ///< metres
  double cross_rest_length = 0;  ///< metres
  double share = 1;              ///< what counts of it
  std::uint32_t spring_class = 0;
  double stiffness = 0, cross_stiffness = 0;          ///< N/m, of the whole
  const double *law = nullptr, *cross_law = nullptr;  ///< SpringConstants::law
};

struct Model {
  const Scene* scene = nullptr;
  Body body;
  std::vector<Material> materials;
  std::vector<std::uint8_t>
      material_of;    ///< of each particle; empty if there is one material, or cells have them
  Mixtures mixtures;  ///< of a body of cells of several materials
  std::vector<double> masses, alphas;  ///< of a whole particle of each material, then of each
                                       ///< mixture: kg; N/m, 0 if it is clamped
  std::vector<Load> loads;
  std::vector<std::pair<Particle, Vec3>> start_velocities;  ///< ascending
  std::vector<double> corners;                              ///< ascending, each once

  std::vector<NeighbourGeometry> neighbours;
  std::vector<SpringConstants>
      springs;  ///< [(a * materials + b) * spring_classes + class], then those of mixtures
  std::vector<std::uint32_t> mixture_springs;  ///< [mixture * neighbours + n] place in `springs`
  double crossings = 0;                        ///< see SpringFacts
  KernelChoice choice;
  KernelSet kernels;
  int degrees_of_freedom = 3;
  double critical_time_step = 0;      ///< s: exact for one material, a rigorous lower bound for
                                      ///< several, and for loads that answer to the motion
  std::string critical_because;       ///< what limits it, in a sentence
  std::vector<std::string> warnings;  ///< sentences: what the scene allows though it is not sound
  std::string two_layers_grow;  ///< of a mirrored layer that is stable: what would grow if both
                                ///< layers were free; empty: nothing
  Vec3 acceleration;            ///< sum of the loads'
  bool answering = false;       ///< some load watches the motion
  bool asks_rate = false;       ///< some criterion asks how fast springs grow

  /// The material of most cells around a particle that stands between several materials.
  std::uint8_t material(Particle particle) const {
    if (!mixtures.empty()) return mixtures.commonest(mixtures.of(particle));
    return material_of.empty() ? std::uint8_t{0} : material_of[particle];
  }
  /// The particle's place in `masses` and `alphas`.
  std::uint32_t kind(Particle particle) const {
    return mixtures.empty() ? material(particle) : mixtures.of(particle);
  }
  double mass(Particle particle) const {
    return body.share(particle) * masses[kind(particle)];
  }  ///< kg
  const SpringConstants& spring(std::uint8_t a, std::uint8_t b, std::uint32_t spring_class) const {
    return springs[(a * materials.size() + b) * body.grid.spring_classes + spring_class];
  }
  /// Constants of the spring to a neighbour that begins at a particle of one kind and ends at one
  /// of another.
  const SpringConstants& spring_to(std::uint32_t neighbour, std::uint32_t here,
                                   std::uint32_t there) const {
    if (!mixtures.empty()) return springs[mixture_springs[here * neighbours.size() + neighbour]];
    return spring(static_cast<std::uint8_t>(here), static_cast<std::uint8_t>(there),
                  neighbours[neighbour].site.spring_class);
  }
  /// The spring from a to b. `neighbour`: of a structured body the index in `neighbours`, of a
  /// listed one that in its list of springs.
  SpringProperties spring_properties(Particle a, Particle b, std::uint32_t neighbour) const;
  /// Those that the spring from a to b is of: its cells', or its ends'.
  SpringMaterials materials_of(Particle a, Particle b, std::uint32_t neighbour) const;
  /// What a criterion of one of its materials is told of a spring. A spring of cells has the part
  /// of each material beside those of the others, as stiff as inside that material; one between two
  /// particles is a whole.
  SpringFacts facts(const SpringProperties& properties, std::uint8_t material) const {
    const double stiffness = mixtures.empty()
                                 ? properties.stiffness
                                 : spring(material, material, properties.spring_class).stiffness;
    return {properties.rest_length, stiffness, body.grid.spacing, properties.spring_class,
            crossings};
  }
  /// Elongation, metres, below which no criterion of its materials breaks the spring from a to b;
  /// infinite if nothing does.
  double alarm(Particle a, Particle b, std::uint32_t neighbour,
               const SpringProperties& properties) const;
};

/// Rest vectors and lengths of a lattice's forward neighbours.
std::vector<NeighbourGeometry> geometry_of(const Grid& grid);

/// Builds the model of a scene. Throws InputError for what only the built body shows (an empty
/// region, two loads on one degree of freedom, a Poisson ratio out of a lattice's reach, particles
/// without material).
std::unique_ptr<Model> build_model(const Scene& scene);

}  // namespace hyperlattice
