// Surfaces and lines that rays meet, searched by Embree.
#pragma once

#include "mesh.hpp"

#include <picture/camera.hpp>

#include <embree3/rtcore.h>

#include <memory>
#include <span>
#include <type_traits>

namespace hyperlattice::render {

/// A point or direction in the space of a camera, pixels.
struct Vec3f {
  float x = 0, y = 0, z = 0;

  friend Vec3f operator+(Vec3f a, Vec3f b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec3f operator-(Vec3f a, Vec3f b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec3f operator*(float s, Vec3f a) { return {s * a.x, s * a.y, s * a.z}; }
};
inline float dot(Vec3f a, Vec3f b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3f cross(Vec3f a, Vec3f b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Vec3f unit(Vec3f a) {
  const float square = dot(a, a);
  return square > 0 ? 1 / std::sqrt(square) * a : a;
}

/// A line of some thickness, m.
struct Line {
  Vec3 from, to;
  bool is_open = false;  ///< the ends are farther apart than at rest
};

struct Hit {
  float depth = 0;          ///< along the ray, in lengths of its direction
  Vec3f normal;             ///< of length 1, towards the origin of the ray
  std::uint32_t index = 0;  ///< of the triangle or line
  bool is_line = false;
};

class RayScene {
 public:
  /// Copies the surface and the lines, of this radius, m, into the space of the camera.
  /// `is_smooth`: normals of the outside are interpolated between points. Throws std::runtime_error
  /// if Embree fails, and std::bad_alloc if it gets no memory.
  RayScene(const Mesh& mesh, std::span<const Line> lines, double radius,
           const picture::Camera& camera, bool is_smooth);

  /// Finds what the ray meets first at a depth above `from`. Threads may call it together.
  bool meet(Vec3f origin, Vec3f direction, float from, Hit& hit) const;
  /// Returns whether the ray meets anything at a depth between the two.
  bool is_blocked(Vec3f origin, Vec3f direction, float from, float to) const;
  /// Returns the least depth of all points, pixels.
  float nearest() const { return nearest_; }

 private:
  struct Release {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  };
  template <class Handle>
  using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Release>;

  void add_mesh(const Mesh& mesh);
  void add_lines(std::span<const Line> lines, double radius, const picture::Camera& camera);
  void add_normals(const Mesh& mesh);
  void check() const;

  Owned<RTCDevice> device_;
  Owned<RTCScene> scene_;
  std::vector<Vec3f> points_, normals_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::vector<bool> is_smooth_;                    ///< of each triangle
  std::uint32_t lines_ = RTC_INVALID_GEOMETRY_ID;  ///< geometry of the lines
  float nearest_ = 0;
};

}  // namespace hyperlattice::render
