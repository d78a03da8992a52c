// A load: forces, prescribed motion or a body acceleration, all following one function of time. It is declared once, before the run;
// the core applies it, accounts for its work, and lands time steps on its corners.
#pragma once

#include <hyperlattice/component.hpp>

namespace hyperlattice {

/// Outward normals of a cell's faces.
inline constexpr Vec3 face_normals[6] = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}};

/// A particle at a surface.
struct OpenArea {
  Particle particle = 0;
  Vec3 area;  ///< sum of the outward normals of the faces that it stands for, each as long as the particle's part of the face is large, m2
};

/// The body as a load sees it.
struct LoadBody {
  void* self = nullptr;
  double spacing = 0;  ///< lattice constant, metres
  std::span<const Particle> (*region_particles)(void* self, RegionId region) noexcept = nullptr;
  Vec3 (*particle_position)(void* self, Particle particle) noexcept = nullptr;
  double (*particle_mass)(void* self, Particle particle) noexcept = nullptr;
  double (*particle_share)(void* self, Particle particle) noexcept = nullptr;
  std::span<const OpenArea> (*region_open_areas)(void* self, RegionId region) noexcept = nullptr;
  double (*region_true_area)(void* self, RegionId region) noexcept = nullptr;
  Vec3 (*region_centre)(void* self, RegionId region) noexcept = nullptr;

  /// In ascending order. Empty is a fault that the core reports itself; the load then need not do anything.
  std::span<const Particle> particles(RegionId region) const { return region_particles(self, region); }
  Vec3 position(Particle particle) const { return particle_position(self, particle); }  ///< metres, at rest
  double mass(Particle particle) const { return particle_mass(self, particle); }        ///< kg
  double share(Particle particle) const { return particle_share(self, particle); }      ///< of a whole particle: below 1 where a body of cells ends
  /// The open faces of the region: to the cavity for "inner_surface", to the outside for "outer_surface", of one side for "x_min" and its like, any
  /// for others. Each particle once, ascending; none if no face is open. The sum is the area of the faces exactly.
  std::span<const OpenArea> open_areas(RegionId region) const { return region_open_areas(self, region); }
  /// Area in m2 of the surface that the scene's shape describes, if the shape knows it (spheres and hollow spheres do); else 0.
  double true_area(RegionId region) const { return region_true_area(self, region); }
  Vec3 centre(RegionId region) const { return region_centre(self, region); }  ///< of the shape behind the region; else of its particles
};

/// Which components of the displacement a prescription fixes: bits 0 x, 1 y, 2 z.
using Axes = std::uint32_t;

/// The same as an option: .choices(axis_set_names).
enum class AxisSet : std::uint32_t { x, y, xy, z, xz, yz, xyz };
inline constexpr std::string_view axis_set_names[] = {"x", "y", "xy", "z", "xz", "yz", "xyz"};
constexpr Axes axes_of(AxisSet set) { return static_cast<Axes>(set) + 1; }

/// From 0 to 1 in a straight line during `rise` seconds, then constant; 1 from the start if rise is 0.
constexpr double ramp(double time, double rise) { return time >= rise ? 1 : time / rise; }

/// Receives what a load does. Each amplitude is multiplied by the load's factor(t).
struct LoadSink {
  void* self = nullptr;
  void (*receive_force)(void* self, Particle particle, Vec3 amplitude) = nullptr;
  void (*receive_displacement)(void* self, Particle particle, Axes axes, Vec3 amplitude) = nullptr;
  void (*receive_velocity)(void* self, Particle particle, Axes axes, Vec3 amplitude) = nullptr;
  void (*receive_acceleration)(void* self, Vec3 acceleration) = nullptr;
  void (*receive_start_velocity)(void* self, Particle particle, Vec3 velocity) = nullptr;
  void (*receive_corner)(void* self, double time) = nullptr;

  void force(Particle particle, Vec3 amplitude) const { receive_force(self, particle, amplitude); }                                 ///< newton
  void displacement(Particle particle, Axes axes, Vec3 amplitude) const { receive_displacement(self, particle, axes, amplitude); }  ///< metres
  void velocity(Particle particle, Axes axes, Vec3 amplitude) const { receive_velocity(self, particle, axes, amplitude); }          ///< m/s
  /// The same for all particles, constant in time (gravity): m/s2; factor(t) does not apply.
  void acceleration(Vec3 value) const { receive_acceleration(self, value); }
  /// Velocity at time 0, before the first step: m/s; factor(t) does not apply.
  void start_velocity(Particle particle, Vec3 value) const { receive_start_velocity(self, particle, value); }
  void corner(double time) const { receive_corner(self, time); }  ///< a time where factor(t) has a kink or jump
};

struct LoadFunctions {
  bool (*declare)(const void* load, const LoadBody& body, const LoadSink& sink, const Complaint& why) noexcept;
  double (*factor)(const void* load, double time) noexcept;
};

/// A load class has: void declare(const LoadBody&, const LoadSink&) const, which throws when its region is unsuitable;
/// and double factor(double time) const, which must not throw.
template <class T>
concept LoadComponent = requires(const T& load, const LoadBody& body, const LoadSink& sink) {
  load.declare(body, sink);
  { load.factor(0.0) } -> std::convertible_to<double>;
};

namespace detail {
template <LoadComponent T>
struct FunctionsOf<T> {
  static constexpr Family family = Family::loads;
  static constexpr LoadFunctions table{
      [](const void* load, const LoadBody& body, const LoadSink& sink, const Complaint& why) noexcept {
        return guarded(why, [&] { static_cast<const T*>(load)->declare(body, sink); });
      },
      [](const void* load, double time) noexcept { return static_cast<double>(static_cast<const T*>(load)->factor(time)); }};
};
}  // namespace detail
}  // namespace hyperlattice
