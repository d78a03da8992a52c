// A load: forces, prescribed motion or a body acceleration, all multiplied by one function of time,
// the load factor. The load declares them once, before the run. The core applies the mean of the
// factor over each time step and counts the load's work. A load whose forces depend on the motion
// also answers: it names the particles that it watches, and returns the force on each in every
// step. It may keep numbers from one step to the next, its memory.
#pragma once

#include <hyperlattice/component.hpp>

#include <utility>

namespace hyperlattice {

/// Outward unit normals of a cell's faces.
inline constexpr Vec3 face_normals[6] = {{-1, 0, 0}, {1, 0, 0},  {0, -1, 0},
                                         {0, 1, 0},  {0, 0, -1}, {0, 0, 1}};

/// A particle at a surface and its part of the surface.
struct OpenArea {
  Particle particle = 0;
  Vec3 area;  ///< sum of the outward normals of the particle's faces, each with the length of the
              ///< particle's part of the face, m2
};

/// A base spring at rest.
struct RestSpring {
  Particle a = 0, b = 0;
  double stiffness = 0;    ///< N/m, already multiplied by `share`
  double share = 1;        ///< fraction of a whole spring; below 1 only at a surface of cells
  double rest_length = 0;  ///< metres
  bool breakable = false;  ///< whether a failure criterion may remove the spring
};

/// A base spring that a cut of the lattice took away, with the cut's surface where it crosses.
struct SeveredSpring {
  Particle a = 0, b = 0;  ///< the normal points from the side of a to the side of b
  double stiffness = 0;   ///< of the spring if it existed, with its share, N/m
  Vec3 rest;              ///< from a to b at rest, m
  Vec3 normal;            ///< of the surface, of length 1
  Vec3 crossing;          ///< where the line from a to b meets the surface, m
};

/// The body as a load sees it.
struct LoadBody {
  void* self = nullptr;
  double spacing = 0;  ///< lattice constant, metres
  /// Distance from the outermost particles to the body's surface, m; 0 with boundary cells.
  double rim = 0;
  std::span<const Particle> (*region_particles)(void* self, RegionId region) noexcept = nullptr;
  Vec3 (*particle_position)(void* self, Particle particle) noexcept = nullptr;
  double (*particle_mass)(void* self, Particle particle) noexcept = nullptr;
  double (*particle_share)(void* self, Particle particle) noexcept = nullptr;
  std::span<const OpenArea> (*region_open_areas)(void* self, RegionId region) noexcept = nullptr;
  double (*region_true_area)(void* self, RegionId region) noexcept = nullptr;
  Vec3 (*region_centre)(void* self, RegionId region) noexcept = nullptr;
  std::span<const RestSpring> (*region_springs)(void* self, RegionId region) noexcept = nullptr;
  double (*particle_gap)(void* self, Particle particle, Vec3 direction) noexcept = nullptr;
  std::span<const SeveredSpring> (*region_cut_springs)(void* self,
                                                       RegionId region) noexcept = nullptr;

  /// Returns the particles of the region in ascending order. The core itself reports an empty
  /// region as an error; the load may then return without declaring anything.
  std::span<const Particle> particles(RegionId region) const {
    return region_particles(self, region);
  }
  /// Returns the position at rest, m.
  Vec3 position(Particle particle) const { return particle_position(self, particle); }
  double mass(Particle particle) const { return particle_mass(self, particle); }  ///< kg
  /// Returns the fraction of a whole particle, 0 to 1; below 1 at the surface of a body of cells.
  double share(Particle particle) const { return particle_share(self, particle); }
  /// Returns the open faces of the region, each particle once, in ascending order; empty if no face
  /// is open. In a body of partial cells the open part of a face is the difference of the shares
  /// of its two cells. The region decides which faces count: those to the cavity for
  /// "inner_surface", to the outside for "outer_surface", of one side for "x_min" and its like, all
  /// open faces for other regions. The sum over the particles is exactly the area of the faces.
  std::span<const OpenArea> open_areas(RegionId region) const {
    return region_open_areas(self, region);
  }
  /// Returns the area, m2, of the surface of the scene's shape, if the shape knows it (spheres and
  /// hollow spheres do); else 0.
  double true_area(RegionId region) const { return region_true_area(self, region); }
  /// Returns the centre, m, of the region's shape, or of its particles if it has no shape.
  Vec3 centre(RegionId region) const { return region_centre(self, region); }
  /// Returns the base springs with one or both ends in the region, each once, sorted by a, then b.
  std::span<const RestSpring> springs(RegionId region) const {
    return region_springs(self, region);
  }
  /// Returns the distance, m, from a particle to the body's shape along a unit vector. 0 if the
  /// particle stands inside the shape or on its surface, as all particles do but the outermost of a
  /// body of partial cells; infinity if the line misses the shape for two spacings.
  double gap(Particle particle, Vec3 direction) const {
    return particle_gap(self, particle, direction);
  }
  /// Returns the springs that cuts took away, with both ends in the region, each once, in the order
  /// of a spring's first end and its neighbours. Where several surfaces cross a spring, it has the
  /// first one. The normal of a region's border, which has no surface, is the mean direction of the
  /// springs from a. Only for grids of base springs alone; the core itself reports other bodies, a
  /// region without cut springs, and springs that another load has asked for, as errors.
  std::span<const SeveredSpring> cut_springs(RegionId region) const {
    return region_cut_springs(self, region);
  }
};

/// Set of the displacement components that a constraint prescribes: bits 0 x, 1 y, 2 z.
using Axes = std::uint32_t;

/// Axes as an option: .choices(axis_set_names).
enum class AxisSet : std::uint32_t { x, y, xy, z, xz, yz, xyz };
inline constexpr std::string_view axis_set_names[] = {"x", "y", "xy", "z", "xz", "yz", "xyz"};
constexpr Axes axes_of(AxisSet set) { return static_cast<Axes>(set) + 1; }

/// Returns a linear ramp from 0 to 1 over `rise` seconds, then 1; always 1 if rise is 0.
constexpr double ramp(double time, double rise) { return time >= rise ? 1 : time / rise; }

/// The motion that a load that answers gets at the start of a step. Arrays hold the watched
/// particles in the order in which the load named them.
struct WatchedMotion {
  double time = 0;                     ///< seconds
  double factor = 1;                   ///< load factor, its mean over the step around `time`
  std::span<const Vec3> displacement;  ///< metres
  std::span<const Vec3> velocity;  ///< m/s, half a step before `time`; forces that depend on it are
                                   ///< first-order accurate in the time step
  std::span<const double> memory;  ///< what the load keeps, as it was after the last step
};

/// Bounds of the derivative of an answered force with the particle's displacement, N/m, and
/// velocity, N s/m. The core needs them to find the stable time step.
struct LoadStiffnessBound {
  double stiffness = 0, viscosity = 0;
};

/// Receives the declarations of a load. The load factor multiplies each amplitude.
struct LoadSink {
  void* self = nullptr;
  void (*receive_force)(void* self, Particle particle, Vec3 amplitude) noexcept = nullptr;
  void (*receive_displacement)(void* self, Particle particle, Axes axes,
                               Vec3 amplitude) noexcept = nullptr;
  void (*receive_velocity)(void* self, Particle particle, Axes axes,
                           Vec3 amplitude) noexcept = nullptr;
  void (*receive_acceleration)(void* self, Vec3 acceleration) noexcept = nullptr;
  void (*receive_start_velocity)(void* self, Particle particle, Vec3 velocity) noexcept = nullptr;
  void (*receive_corner)(void* self, double time) noexcept = nullptr;
  void (*receive_watched)(void* self, Particle particle, bool answered,
                          const LoadStiffnessBound& reaction) noexcept = nullptr;
  void (*receive_warning)(void* self, std::string_view sentence) noexcept = nullptr;
  void (*receive_frequency)(void* self, double hertz) noexcept = nullptr;
  void (*receive_memory)(void* self, std::uint64_t numbers) noexcept = nullptr;

  /// Adds a force, N.
  void force(Particle particle, Vec3 amplitude) const { receive_force(self, particle, amplitude); }
  /// Prescribes displacement components, m.
  void displacement(Particle particle, Axes axes, Vec3 amplitude) const {
    receive_displacement(self, particle, axes, amplitude);
  }
  /// Prescribes velocity components, m/s.
  void velocity(Particle particle, Axes axes, Vec3 amplitude) const {
    receive_velocity(self, particle, axes, amplitude);
  }
  /// Adds an acceleration, m/s2, of all particles, constant in time (gravity). The load factor does
  /// not apply.
  void acceleration(Vec3 value) const { receive_acceleration(self, value); }
  /// Sets the velocity, m/s, at time 0, before the first step. The load factor does not apply.
  void start_velocity(Particle particle, Vec3 value) const {
    receive_start_velocity(self, particle, value);
  }
  /// Names a time, s, at which the load factor has a kink or a jump; means over steps are then
  /// exact.
  void corner(double time) const { receive_corner(self, time); }
  /// Tells the highest frequency, Hz, of the load factor; the core refuses time steps that are too
  /// long for it, or warns of them.
  void frequency(double hertz) const { receive_frequency(self, hertz); }
  /// Watches a particle and answers with a force on it. Watched particles are numbered from 0; each
  /// may be named once.
  void watch(Particle particle, const LoadStiffnessBound& reaction = {}) const {
    receive_watched(self, particle, true, reaction);
  }
  /// Watches a particle without a force on it. It takes a number among the watched particles.
  void look_at(Particle particle) const { receive_watched(self, particle, false, {}); }
  /// Lets the load keep so many numbers from one step to the next; all start at zero. They are part
  /// of the state: checkpoints and the state's hash hold them.
  void remember(std::uint64_t numbers) const { receive_memory(self, numbers); }
  /// Warns of input that is allowed, but probably a mistake.
  void warn(std::string_view sentence) const { receive_warning(self, sentence); }
};

/// Functions of a load across the boundary.
struct LoadFunctions {
  bool (*declare)(void* load, const LoadBody& body, const LoadSink& sink,
                  const Complaint& why) noexcept;
  bool (*factor)(const void* load, double time, double& factor, const Complaint& why) noexcept;
  /// Null if the load does not answer.
  bool (*answer)(const void* load, const WatchedMotion& motion, std::size_t n, Vec3& force,
                 const Complaint& why) noexcept;
  bool (*prepare)(void* load, const WatchedMotion& motion,
                  const Complaint& why) noexcept;  ///< called before the answers to a motion; null:
                                                   ///< nothing to prepare
  bool (*update)(const void* load, const WatchedMotion& motion, std::span<double> memory,
                 const Complaint& why) noexcept;  ///< null: the load has no memory
};

/// A load class has: void declare(const LoadBody&, const LoadSink&), called once, which throws if
/// its region is unsuitable; and double factor(double time) const. An exception from factor ends
/// the run.
template <class T>
concept LoadComponent = requires(T& load, const LoadBody& body, const LoadSink& sink) {
  load.declare(body, sink);
  { std::as_const(load).factor(0.0) } -> std::convertible_to<double>;
};

/// A load that answers also has: Vec3 answer(const WatchedMotion&, std::size_t n) const, which
/// returns the force, N, on the n-th watched particle. Several threads may call it at once; it must
/// depend on nothing but its arguments. The core does not multiply the answer by the load factor.
/// The load may have void prepare(const WatchedMotion&), which one thread calls once before the
/// answers to a motion. Answers must not depend on earlier answers.
///
/// A load with a memory (LoadSink::remember) also has void update(const WatchedMotion&,
/// std::span<double> memory) const. One thread calls it once in each step, after the answers to the
/// motion, which saw the memory of before. Measurements ask for answers too, and update nothing.
template <class T>
concept AnsweringLoad = LoadComponent<T> && requires(const T& load, const WatchedMotion& motion) {
  { load.answer(motion, std::size_t{}) } -> std::convertible_to<Vec3>;
};

namespace detail {
template <LoadComponent T>
constexpr auto answer_of() -> decltype(LoadFunctions::answer) {
  if constexpr (AnsweringLoad<T>)
    return [](const void* load, const WatchedMotion& motion, std::size_t n, Vec3& force,
              const Complaint& why) noexcept {
      return guarded(why, [&] { force = static_cast<const T*>(load)->answer(motion, n); });
    };
  else
    return nullptr;
}

template <LoadComponent T>
constexpr auto prepare_of() -> decltype(LoadFunctions::prepare) {
  if constexpr (requires(T & load, const WatchedMotion& motion) { load.prepare(motion); })
    return [](void* load, const WatchedMotion& motion, const Complaint& why) noexcept {
      return guarded(why, [&] { static_cast<T*>(load)->prepare(motion); });
    };
  else
    return nullptr;
}

template <LoadComponent T>
constexpr auto update_of() -> decltype(LoadFunctions::update) {
  if constexpr (requires(const T& load, const WatchedMotion& motion, std::span<double> memory) {
                  load.update(motion, memory);
                })
    return [](const void* load, const WatchedMotion& motion, std::span<double> memory,
              const Complaint& why) noexcept {
      return guarded(why, [&] { static_cast<const T*>(load)->update(motion, memory); });
    };
  else
    return nullptr;
}

template <LoadComponent T>
struct FunctionsOf<T> {
  static constexpr Family family = Family::loads;
  static constexpr LoadFunctions table{
      [](void* load, const LoadBody& body, const LoadSink& sink, const Complaint& why) noexcept {
        return guarded(why, [&] { static_cast<T*>(load)->declare(body, sink); });
      },
      [](const void* load, double time, double& factor, const Complaint& why) noexcept {
        return guarded(why, [&] { factor = static_cast<const T*>(load)->factor(time); });
      },
      answer_of<T>(), prepare_of<T>(), update_of<T>()};
};
}  // namespace detail
}  // namespace hyperlattice

#include <hyperlattice/boundary.hpp>  // the gate needs all structs of the boundary
