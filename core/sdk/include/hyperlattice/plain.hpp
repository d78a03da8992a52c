// Plain types that cross the boundary between the core and a plugin: no allocation, no exceptions,
// no library types.
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <limits>
#include <new>
#include <span>
#include <string_view>

namespace hyperlattice {

/// A point or direction in space, metres or dimensionless.
struct Vec3 {
  double x = 0, y = 0, z = 0;

  /// Returns the component along an axis: 0 for x, 1 for y, 2 for z.
  constexpr double operator[](std::integral auto axis) const {
    return axis == 0 ? x : axis == 1 ? y : z;
  }
  constexpr double& operator[](std::integral auto axis) {
    return axis == 0 ? x : axis == 1 ? y : z;
  }

  friend constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
  friend constexpr Vec3 operator*(double s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
  friend constexpr Vec3 operator*(Vec3 a, double s) { return s * a; }
  /// Divides each component by `s`. The last bits can differ from those of (1 / s) * a.
  friend constexpr Vec3 operator/(Vec3 a, double s) { return {a.x / s, a.y / s, a.z / s}; }
  constexpr Vec3& operator+=(Vec3 b) { return *this = *this + b; }
  constexpr Vec3& operator-=(Vec3 b) { return *this = *this - b; }
  constexpr Vec3& operator*=(double s) { return *this = s * *this; }
  constexpr Vec3& operator/=(double s) { return *this = *this / s; }
  friend constexpr bool operator==(Vec3, Vec3) = default;
};

constexpr double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// Returns the Euclidean length.
inline double norm(Vec3 a) { return std::sqrt(dot(a, a)); }
/// Returns a finite vector over a power of two, so that its largest component is between 1/2 and 1
/// and no product of components overflows or underflows. Zero stays zero.
inline Vec3 scaled(Vec3 a) {
  int exponent = 0;
  std::frexp(std::fmax(std::abs(a.x), std::fmax(std::abs(a.y), std::abs(a.z))), &exponent);
  for (int axis = 0; axis < 3; ++axis) a[axis] = std::ldexp(a[axis], -exponent);
  return a;
}
/// Returns the vector of length 1 along a finite vector of any length but zero.
inline Vec3 direction_of(Vec3 a) { return scaled(a) / norm(scaled(a)); }

/// Index of a particle: its position in the lattice's order, by z, then y, then x.
using Particle = std::uint64_t;

/// A region of the scene, resolved by the core; the value of a component's region option.
struct RegionId {
  std::uint32_t index = 0;
};

/// A load or a region of the scene; the value of an option that takes the name of either.
struct LoadOrRegion {
  RegionId region;
  std::int32_t load = -1;  ///< number among the loads, in the order of the scene; -1: the region

  bool is_load() const { return load >= 0; }
};

/// A solid described by the scene. `anchor`, m, is the point where a lattice puts a corner of its
/// cells: the centre of round shapes, the low corner of boxes, so that whole cells fill a box
/// exactly.
struct Shape {
  const void* self = nullptr;
  bool (*contains_point)(const void* self, Vec3 point) noexcept = nullptr;
  Vec3 low, high;  ///< bounding box, metres
  Vec3 anchor;
  double (*share_of_cube)(const void* self, Vec3 low, double edge) noexcept = nullptr;

  bool contains(Vec3 point) const { return contains_point(self, point); }
  /// Returns the part, 0 to 1, of a cube's volume that lies inside, correct to 1e-4. The cube has
  /// its low corner at `low`, and edges of `edge` metres along the axes.
  double share(Vec3 low_corner, double edge) const { return share_of_cube(self, low_corner, edge); }
};

/// Receives the error message of a function that was called across the boundary and failed.
struct Complaint {
  void* self = nullptr;
  void (*receive)(void* self, std::string_view sentence) noexcept = nullptr;

  void say(std::string_view sentence) const { receive(self, sentence); }
};

/// The message of a function that got no memory. The host recognises it.
inline constexpr std::string_view out_of_memory = "std::bad_alloc";

// Errors across the boundary. Every function of a plugin that the host calls takes a Complaint and
// returns whether it succeeded; an exception becomes the Complaint's message. Functions of the host
// that a plugin calls throw nothing: the host keeps its error until the plugin's function has
// returned. They are called on the thread of the plugin's function.

namespace detail {

/// Runs code of a plugin. Turns an exception into a message, so that none crosses the boundary.
template <class Code>
bool guarded(const Complaint& why, Code&& code) noexcept {
  try {
    code();
    return true;
  } catch (const std::bad_alloc&) {
    why.say(out_of_memory);
  } catch (const std::exception& error) {
    why.say(error.what());
  } catch (...) {
    why.say("an exception of unknown type");
  }
  return false;
}

}  // namespace detail

inline constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace hyperlattice
