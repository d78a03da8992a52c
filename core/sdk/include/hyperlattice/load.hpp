// A load: forces, prescribed motion or a body acceleration, all following one function of time. It
// is declared once, before the run; the core applies its mean over each time step, and accounts for
// its work. A load whose forces depend on the motion also answers: it names the particles that it
// watches, and once a step is asked for the force on each.
#pragma once

#include <hyperlattice/component.hpp>

#include <utility>

namespace hyperlattice {

/// Outward normals of a cell's faces.
inline constexpr Vec3 face_normals[6] = {{-1, 0, 0}, {1, 0, 0},  {0, -1, 0},
                                         {0, 1, 0},  {0, 0, -1}, {0, 0, 1}};

/// A particle at a surface.
struct OpenArea {
  Particle particle = 0;
  Vec3 area;  ///< sum of the outward normals of the faces that it stands for, each as long as the
              ///< particle's part of the face is large, m2
};

/// A base spring.
struct RestSpring {
  Particle a = 0, b = 0;
  double stiffness = 0;    ///< N/m; at the surface of a body of cells its share of the whole
  double share = 1;        ///< of a whole spring
  double rest_length = 0;  ///< metres
  bool breakable = false;  ///< a criterion may remove it
};

/// The body as a load sees it.
struct LoadBody {
  void* self = nullptr;
  double spacing = 0;  ///< lattice constant, metres
  double rim = 0;  ///< how far the body reaches beyond its outermost particles, metres: nothing if
                   ///< particles are the corners of cells
  std::span<const Particle> (*region_particles)(void* self, RegionId region) noexcept = nullptr;
  Vec3 (*particle_position)(void* self, Particle particle) noexcept = nullptr;
  double (*particle_mass)(void* self, Particle particle) noexcept = nullptr;
  double (*particle_share)(void* self, Particle particle) noexcept = nullptr;
  std::span<const OpenArea> (*region_open_areas)(void* self, RegionId region) noexcept = nullptr;
  double (*region_true_area)(void* self, RegionId region) noexcept = nullptr;
  Vec3 (*region_centre)(void* self, RegionId region) noexcept = nullptr;
  std::span<const RestSpring> (*region_springs)(void* self, RegionId region) noexcept = nullptr;

  /// In ascending order. Empty is a fault that the core reports itself; the load then need not do
  /// anything.
  std::span<const Particle> particles(RegionId region) const {
    return region_particles(self, region);
  }
  Vec3 position(Particle particle) const {
    return particle_position(self, particle);
  }  ///< metres, at rest
  double mass(Particle particle) const { return particle_mass(self, particle); }  ///< kg
  double share(Particle particle) const {
    return particle_share(self, particle);
  }  ///< of a whole particle: below 1 where a body of cells ends
  /// The open faces of the region: to the cavity for "inner_surface", to the outside for
  /// "outer_surface", of one side for "x_min" and its like, any for others. Each particle once,
  /// ascending; none if no face is open. The sum is the area of the faces exactly.
  std::span<const OpenArea> open_areas(RegionId region) const {
    return region_open_areas(self, region);
  }
  /// Area in m2 of the surface that the scene's shape describes, if the shape knows it (spheres and
  /// hollow spheres do); else 0.
  double true_area(RegionId region) const { return region_true_area(self, region); }
  Vec3 centre(RegionId region) const {
    return region_centre(self, region);
  }  ///< of the shape behind the region; else of its particles
  /// The base springs with one end or both in the region, each once, in the order of a, then b.
  std::span<const RestSpring> springs(RegionId region) const {
    return region_springs(self, region);
  }
};

/// Which components of the displacement a prescription fixes: bits 0 x, 1 y, 2 z.
using Axes = std::uint32_t;

/// The same as an option: .choices(axis_set_names).
enum class AxisSet : std::uint32_t { x, y, xy, z, xz, yz, xyz };
inline constexpr std::string_view axis_set_names[] = {"x", "y", "xy", "z", "xz", "yz", "xyz"};
constexpr Axes axes_of(AxisSet set) { return static_cast<Axes>(set) + 1; }

/// From 0 to 1 in a straight line during `rise` seconds, then constant; 1 from the start if rise is
/// 0.
constexpr double ramp(double time, double rise) { return time >= rise ? 1 : time / rise; }

/// What a load that answers sees at a step's start: the particles that it watches, in the order in
/// which it named them.
struct WatchedMotion {
  double time = 0;                     ///< seconds
  double factor = 1;                   ///< the load's, its mean over the step around that time
  std::span<const Vec3> displacement;  ///< metres
  std::span<const Vec3> velocity;  ///< m/s, half a step before: forces that depend on it are true
                                   ///< to the first power of the step
};

/// How strongly an answer may react: bounds of its change with the particle's displacement, N/m,
/// and velocity, N s/m. The stable step is found with them.
struct LoadStiffnessBound {
  double stiffness = 0, viscosity = 0;
};

/// Receives what a load does. Each amplitude is multiplied by the load's factor(t).
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

  void force(Particle particle, Vec3 amplitude) const {
    receive_force(self, particle, amplitude);
  }  ///< newton
  void displacement(Particle particle, Axes axes, Vec3 amplitude) const {
    receive_displacement(self, particle, axes, amplitude);
  }  ///< metres
  void velocity(Particle particle, Axes axes, Vec3 amplitude) const {
    receive_velocity(self, particle, axes, amplitude);
  }  ///< m/s
  /// The same for all particles, constant in time (gravity): m/s2; factor(t) does not apply.
  void acceleration(Vec3 value) const { receive_acceleration(self, value); }
  /// Velocity at time 0, before the first step: m/s; factor(t) does not apply.
  void start_velocity(Particle particle, Vec3 value) const {
    receive_start_velocity(self, particle, value);
  }
  void corner(double time) const {
    receive_corner(self, time);
  }  ///< a time where factor(t) has a kink or jump: means over steps are then exact
  /// factor(t) oscillates, at most that often in a second: steps that are too long for it are
  /// refused or warned of.
  void frequency(double hertz) const { receive_frequency(self, hertz); }
  /// The load will answer for the particle; those that are watched count from 0, each is named
  /// once.
  void watch(Particle particle, const LoadStiffnessBound& reaction = {}) const {
    receive_watched(self, particle, true, reaction);
  }
  /// The particle is only looked at; it counts among the watched.
  void look_at(Particle particle) const { receive_watched(self, particle, false, {}); }
  void warn(std::string_view sentence) const {
    receive_warning(self, sentence);
  }  ///< what is allowed, but hardly meant
};

struct LoadFunctions {
  bool (*declare)(void* load, const LoadBody& body, const LoadSink& sink,
                  const Complaint& why) noexcept;
  bool (*factor)(const void* load, double time, double& factor, const Complaint& why) noexcept;
  /// Null: the load does not answer.
  bool (*answer)(const void* load, const WatchedMotion& motion, std::size_t n, Vec3& force,
                 const Complaint& why) noexcept;
  bool (*prepare)(void* load, const WatchedMotion& motion,
                  const Complaint& why) noexcept;  ///< before answers; null: nothing to prepare
};

/// A load class has: void declare(const LoadBody&, const LoadSink&), which throws when its region
/// is unsuitable, and is called once; and double factor(double time) const. What factor throws ends
/// the run.
template <class T>
concept LoadComponent = requires(T& load, const LoadBody& body, const LoadSink& sink) {
  load.declare(body, sink);
  { std::as_const(load).factor(0.0) } -> std::convertible_to<double>;
};

/// One that answers also has: Vec3 answer(const WatchedMotion&, std::size_t n) const, the force on
/// the n-th watched particle in newton. It may be called by several threads at once, and depends on
/// nothing but its arguments. factor(t) does not apply by itself. It may have void prepare(const
/// WatchedMotion&), called once by one thread before it answers for a motion; what answers are must
/// not depend on earlier ones.
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
struct FunctionsOf<T> {
  static constexpr Family family = Family::loads;
  static constexpr LoadFunctions table{
      [](void* load, const LoadBody& body, const LoadSink& sink, const Complaint& why) noexcept {
        return guarded(why, [&] { static_cast<T*>(load)->declare(body, sink); });
      },
      [](const void* load, double time, double& factor, const Complaint& why) noexcept {
        return guarded(why, [&] { factor = static_cast<const T*>(load)->factor(time); });
      },
      answer_of<T>(), prepare_of<T>()};
};
}  // namespace detail
}  // namespace hyperlattice

#include <hyperlattice/boundary.hpp>  // the gate, once all that a family hands over is known
