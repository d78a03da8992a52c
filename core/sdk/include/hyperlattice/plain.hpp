// Plain types that cross the boundary between the core and a plugin: no allocation, no exceptions,
// no library types.
#pragma once

#include <cmath>
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

  friend constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vec3 operator*(double s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
  friend constexpr bool operator==(Vec3, Vec3) = default;
};

constexpr double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(Vec3 a) { return std::sqrt(dot(a, a)); }

/// Index of a particle: its place in the order z, then y, then x of the lattice.
using Particle = std::uint64_t;

/// A region of the scene, resolved by the core; what a region option of a component holds.
struct RegionId {
  std::uint32_t index = 0;
};

/// A solid described by the scene. `anchor` is where a lattice puts a corner of its cells: the
/// centre of round shapes, the low corner of boxes, so that a box of whole cells is filled exactly.
struct Shape {
  const void* self = nullptr;
  bool (*contains_point)(const void* self, Vec3 point) noexcept = nullptr;
  Vec3 low, high;  ///< bounding box, metres
  Vec3 anchor;

  bool contains(Vec3 point) const { return contains_point(self, point); }
};

/// Where a function called across the boundary leaves the sentence that says why it failed.
struct Complaint {
  void* self = nullptr;
  void (*receive)(void* self, std::string_view sentence) noexcept = nullptr;

  void say(std::string_view sentence) const { receive(self, sentence); }
};

/// The sentence of a function that got no memory. The host tells it from any other.
inline constexpr std::string_view out_of_memory = "std::bad_alloc";

// Errors, in both directions. Every function of a plugin that the host calls returns whether it did
// its work and takes a Complaint; an exception becomes the complaint's sentence. Functions of the
// host that a plugin calls throw nothing: the host keeps its error until the plugin's function has
// returned. They are called on the thread on which the plugin's function was called.

namespace detail {

/// Runs code of a plugin; an exception becomes a sentence, so that none crosses the boundary.
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
