// The model of a scene: particles, springs, masses and loads. It does not change during a run.
#pragma once

#include <model/composite_spring.hpp>
#include <model/law.hpp>
#include <model/mixtures.hpp>
#include <scene/scene.hpp>

#include <hyperlattice/failure.hpp>
#include <hyperlattice/kernel_request.hpp>
#include <hyperlattice/load.hpp>
#include <hyperlattice/material.hpp>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace hyperlattice {

/// Destroys a component through its plugin. If the destructor crashes, the last line of the program
/// names the plugin.
struct Destroy {
  const Component* of = nullptr;
  void operator()(void* made) const;
};
/// A component made from its stage. The plugin that made it destroys it.
using ComponentPointer = std::unique_ptr<void, Destroy>;
/// Makes the component of a stage. Throws InputError at the stage's pointer if the component
/// refuses its options.
ComponentPointer make_component(const Stage& stage);

struct Material {
  const Stage* stage = nullptr;
  ComponentPointer component;
  MaterialConstants constants;
  std::uint32_t law = 0;  ///< index in Model::laws
  double mass = 0;                ///< mass of a whole particle, kg
  double critical_time_step = 0;  ///< for the infinite lattice of this material, s

  /// A failure criterion of the material's springs.
  struct Criterion {
    const Stage* stage = nullptr;
    ComponentPointer component;
    std::uint32_t number = 0;  ///< among the criteria of all materials
    /// Memory with which each spring starts; see FailureFunctions::start.
    std::array<double, max_failure_memory> start{};
    /// Returns the elongation, m, below which the criterion breaks no such spring.
    double alarm(const SpringFacts& spring) const;
  };
  /// In the order of the scene: the first one that is met breaks a spring. Empty: the springs do
  /// not break.
  std::vector<Criterion> failures;
  /// Returns the smallest alarm of all criteria, m; infinite without criteria.
  double alarm(const SpringFacts& spring) const;
};

/// All that a load declared for one particle.
struct LoadedParticle {
  Particle particle = 0;
  Vec3 force;                      ///< amplitude of the force, N
  Axes displaced = 0, driven = 0;  ///< axes with a prescribed displacement, velocity
  Vec3 displacement, velocity;     ///< amplitudes, m and m/s
};
struct WatchedParticle {
  Particle particle = 0;
  bool answered = true;  ///< false: the load reads the motion but exerts no force
  LoadStiffnessBound reaction;
};
struct Load {
  const Stage* stage = nullptr;
  ComponentPointer component;
  std::vector<LoadedParticle> particles;  ///< ascending, each once
  std::vector<WatchedParticle> watched;   ///< in the order in which the load named them
  std::vector<double> corners;  ///< times of kinks and jumps of the factor, s; ascending, each once
  double frequency = 0;  ///< highest frequency at which the factor oscillates, Hz; 0: none declared
  Vec3 acceleration;
  // Each of these functions throws OutsideError if the load throws. They do not check for NaN; the
  // run does.
  double factor(double time) const;
  /// Returns the factor at `time`; if `time` is a corner of the load, the value just after it.
  double after(double time) const;
  /// Returns the mean of the factor in [from, to]; exact between corners for polynomials up to
  /// degree 9.
  double mean(double from, double to) const;
  /// Returns the integral of the factor over an interval of any length, s, to about 1e-12.
  double integral(double from, double to) const;
  /// Value and slope, 1/s, of the factor just after `time`, or just before it if `reach` is
  /// negative. They are computed from samples within |reach| seconds, up to a corner.
  struct Limit {
    double value = 0, slope = 0;
  };
  Limit limit(double time, double reach) const;
  /// Returns whether prepare() must be called before the answers to a motion.
  bool prepares() const {
    return !watched.empty() && stage->functions<LoadFunctions>().prepare != nullptr;
  }
  void prepare(const WatchedMotion& motion) const;
  /// Returns the force on the n-th watched particle, N.
  Vec3 answer(const WatchedMotion& motion, std::size_t n) const;
};

/// The properties of one base spring and of its cross springs.
struct SpringProperties {
  Vec3 rest;                     ///< rest vector from the first end to the second, m
  double rest_length = 0;        ///< metres
  double cross_rest_length = 0;  ///< metres
  double share = 1;              ///< share of the whole spring, 0 to 1
  std::uint32_t spring_class = 0;
  double stiffness = 0, cross_stiffness = 0;          ///< of the whole spring, N/m
  /// The law by its index in Model::laws, and its constants of base and cross springs.
  std::uint32_t law = 0;
  const double* constants[2] = {};
  /// The parts of a spring of several laws or constants, which `law` and `constants` do not
  /// describe; null: a spring of one law.
  const CompositeSpring* composite = nullptr;
  double factor = 1;  ///< stiffness of a listed spring over that of its class

  double rest_length_of(std::size_t cross) const {
    return cross == 0 ? rest_length : cross_rest_length;
  }
  double stiffness_of(std::size_t cross) const {
    return cross == 0 ? stiffness : cross_stiffness;
  }
};

struct Model {
  const Scene* scene = nullptr;
  Body body;
  std::vector<Material> materials;
  /// Material of each particle; empty if there is one material, or if cells have the materials.
  std::vector<std::uint8_t> material_of;
  Mixtures mixtures;  ///< for a body of cells of several materials
  /// Mass, kg, and alpha stiffness, N/m (0 if clamped), of a whole particle: first of each
  /// material, then of each mixture; index: kind().
  std::vector<double> masses, alphas;
  std::vector<Load> loads;
  std::vector<std::pair<Particle, Vec3>> start_velocities;  ///< ascending
  std::vector<double> corners;                              ///< ascending, each once

  std::vector<NeighbourGeometry> neighbours;
  /// [(a * materials + b) * spring_classes + class], then the springs of mixtures
  std::vector<SpringConstants> springs;
  /// [mixture * neighbours + n]: index in `springs`
  std::vector<std::uint32_t> mixture_springs;
  /// The parts of each spring in `springs` by their index in `composites`; -1, or beyond the end: a
  /// spring of one law.
  std::vector<std::int32_t> composite_of;
  std::vector<CompositeSpring> composites;
  double crossings = 0;  ///< base springs through a unit of area, 1/m2, see SpringFacts
  KernelChoice choice;
  std::vector<Law> laws;  ///< each once; the first one's kernels move the particles
  std::uint32_t memory = 0;  ///< numbers that each base or cross spring keeps
  bool softens = false;      ///< whether a law softens
  int degrees_of_freedom = 3;
  /// Stable time step, s: exact for one material, a rigorous lower bound for several materials and
  /// for loads that answer to the motion.
  double critical_time_step = 0;
  std::string critical_because;       ///< sentence: what limits the time step
  std::vector<std::string> warnings;  ///< about settings that are allowed but not sound
  /// If the mirrored layer is stable: a sentence about the deformation that would grow if both
  /// layers were free; empty if none would.
  std::string two_layers_grow;
  Vec3 acceleration;       ///< sum of the body accelerations of all loads, m/s2
  bool answering = false;  ///< whether a load watches the motion
  bool asks_rate = false;  ///< whether a failure criterion needs the rate of elongation

  /// Returns the particle's material. A particle between several materials has the material of most
  /// cells around it.
  std::uint8_t material(Particle particle) const {
    if (!mixtures.empty()) return mixtures.commonest(mixtures.of(particle));
    return material_of.empty() ? std::uint8_t{0} : material_of[particle];
  }
  /// Returns the particle's index in `masses` and `alphas`.
  std::uint32_t kind(Particle particle) const {
    return mixtures.empty() ? material(particle) : mixtures.of(particle);
  }
  double mass(Particle particle) const {
    return body.share(particle) * masses[kind(particle)];
  }  ///< kg
  const SpringConstants& spring(std::uint8_t a, std::uint8_t b, std::uint32_t spring_class) const {
    return springs[spring_index(a, b, spring_class)];
  }
  std::size_t spring_index(std::uint8_t a, std::uint8_t b, std::uint32_t spring_class) const {
    return (a * materials.size() + b) * body.grid.spring_classes + spring_class;
  }
  /// Makes the spring with this index in `springs` a composite one.
  void add_composite(std::size_t spring, CompositeSpring composite);
  /// Returns the constants of the spring to a neighbour from a particle of kind `here` to one of
  /// kind `there`.
  const SpringConstants& spring_to(std::uint32_t neighbour, std::uint32_t here,
                                   std::uint32_t there) const {
    if (!mixtures.empty()) return springs[mixture_springs[here * neighbours.size() + neighbour]];
    return spring(static_cast<std::uint8_t>(here), static_cast<std::uint8_t>(there),
                  neighbours[neighbour].site.spring_class);
  }
  const KernelSet& kernels() const { return laws.front().kernels; }
  /// Returns the parts of a spring in `springs`; null if it has one law.
  const CompositeSpring* composite(const SpringConstants& of) const {
    const auto index = static_cast<std::size_t>(&of - springs.data());
    if (index >= composite_of.size() || composite_of[index] < 0) return nullptr;
    return &composites[static_cast<std::size_t>(composite_of[index])];
  }
  /// Returns the properties of the spring from a to b. `neighbour`: in a structured body the index
  /// in `neighbours`, in a listed body the index in its list of springs.
  SpringProperties spring_properties(Particle a, Particle b, std::uint32_t neighbour) const;
  /// Returns the materials of the spring from a to b: those of its cells in a body of cells of
  /// several materials, else those of its ends.
  SpringMaterials materials_of(Particle a, Particle b, std::uint32_t neighbour) const;
  /// Returns what the failure criterion of `material` knows of a spring. A spring of several
  /// materials consists of one part for each material; the criterion is asked about a whole spring
  /// of its material with the force of this part, see elongation_in().
  SpringFacts facts(const SpringProperties& properties, std::uint8_t material) const {
    const double stiffness =
        properties.factor * spring(material, material, properties.spring_class).stiffness;
    return {properties.rest_length, stiffness, body.grid.spacing, properties.spring_class,
            crossings};
  }
  /// Returns the elongation, m, of a whole spring of `material` with the force of this material's
  /// part of a spring. `kept`: memory of the spring; used by composite springs.
  double elongation_in(std::uint8_t material, const SpringProperties& properties,
                       double elongation, const double* kept) const;
  /// Returns the elongation, m, of a whole spring of `material`, with the rest length of a spring,
  /// below which this material's criterion does not break it; infinite if it has none.
  double own_alarm(std::uint8_t material, const SpringProperties& properties) const;
  /// Returns the elongation, m, below which no criterion breaks the spring from a to b; infinite if
  /// none can.
  double alarm(Particle a, Particle b, std::uint32_t neighbour,
               const SpringProperties& properties) const;
};

/// Returns the rest vectors and lengths of a lattice's forward neighbours.
std::vector<NeighbourGeometry> geometry_of(const Grid& grid);

/// Builds the model of a scene. Throws InputError for errors that only the built body shows (an
/// empty region, two loads on one degree of freedom, a Poisson ratio out of a lattice's reach,
/// particles without material).
std::unique_ptr<Model> build_model(const Scene& scene);

}  // namespace hyperlattice
