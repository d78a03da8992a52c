#include "ray_scene.hpp"

#include <algorithm>
#include <cmath>
#include <new>
#include <stdexcept>
#include <string>

namespace hyperlattice::render {

namespace {

Vec3f narrow(Vec3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

[[noreturn]] void fail(RTCError error) {
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  throw std::runtime_error("Embree fails with its error " + std::to_string(error));
}

void fill(RTCRay& ray, Vec3f origin, Vec3f direction, float from, float to) {
  ray.org_x = origin.x;
  ray.org_y = origin.y;
  ray.org_z = origin.z;
  ray.dir_x = direction.x;
  ray.dir_y = direction.y;
  ray.dir_z = direction.z;
  ray.tnear = from;
  ray.tfar = to;
  ray.time = 0;
  ray.mask = ~0U;
  ray.id = 0;
  ray.flags = 0;
}

}  // namespace

void RayScene::check() const {
  if (const RTCError error = rtcGetDeviceError(device_.get()); error != RTC_ERROR_NONE) fail(error);
}

/// One thread: a writer starts none.
RayScene::RayScene(const Mesh& mesh, std::span<const Line> lines, double radius,
                   const picture::Camera& camera, bool is_smooth)
    : device_(rtcNewDevice("threads=1,start_threads=0,set_affinity=0")) {
  if (!device_) fail(rtcGetDeviceError(nullptr));
  scene_.reset(rtcNewScene(device_.get()));
  check();
  rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);  // no ray passes between two triangles
  points_.reserve(mesh.points.size() + 1);  // Embree may read 16 bytes at the last point
  for (const Vec3 point : mesh.points) points_.push_back(narrow(camera.to_view(point)));
  add_mesh(mesh);
  if (is_smooth) add_normals(mesh);
  if (!lines.empty()) add_lines(lines, radius, camera);
  rtcCommitScene(scene_.get());
  check();
  RTCBounds bounds;
  rtcGetSceneBounds(scene_.get(), &bounds);
  nearest_ = std::isfinite(bounds.lower_z) ? bounds.lower_z : 0;  // infinite in an empty scene
}

void RayScene::add_mesh(const Mesh& mesh) {
  const auto is_finite = [&](std::uint32_t point) {
    return std::isfinite(points_[point].x + points_[point].y + points_[point].z);
  };
  for (const Triangle& triangle : mesh.triangles)
    triangles_.push_back(std::all_of(triangle.points.begin(), triangle.points.end(), is_finite)
                             ? triangle.points
                             : std::array<std::uint32_t, 3>{});  // a point, which no ray meets
  if (triangles_.empty()) return;
  RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, points_.data(),
                             0, sizeof(Vec3f), points_.size());
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                             triangles_.data(), 0, sizeof triangles_[0], triangles_.size());
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_.get(), geometry);
  rtcReleaseGeometry(geometry);
  check();
}

void RayScene::add_lines(std::span<const Line> lines, double radius,
                         const picture::Camera& camera) {
  RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
  check();
  auto* const ends = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), 2 * lines.size()));
  auto* const starts = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, sizeof(std::uint32_t), lines.size()));
  if (ends == nullptr || starts == nullptr) {
    rtcReleaseGeometry(geometry);
    check();
    throw std::bad_alloc();
  }
  for (std::size_t n = 0; n < lines.size(); ++n) {
    starts[n] = static_cast<std::uint32_t>(2 * n);
    for (std::size_t end = 0; end < 2; ++end) {
      const Vec3f point = narrow(camera.to_view(end == 0 ? lines[n].from : lines[n].to));
      float* const to = ends + 4 * (2 * n + end);
      to[0] = point.x;
      to[1] = point.y;
      to[2] = point.z;
      to[3] = static_cast<float>(radius * camera.scale);
    }
  }
  rtcCommitGeometry(geometry);
  lines_ = rtcAttachGeometry(scene_.get(), geometry);
  rtcReleaseGeometry(geometry);
  check();
}

/// The normal of a point is the mean of those of its triangles, by area.
void RayScene::add_normals(const Mesh& mesh) {
  normals_.resize(points_.size());
  for (const Triangle& triangle : mesh.triangles) {
    is_smooth_.push_back(triangle.part == Part::outside);
    if (!is_smooth_.back()) continue;
    const auto [a, b, c] = triangle.points;
    const Vec3f normal = cross(points_[b] - points_[a], points_[c] - points_[a]);
    for (const std::uint32_t point : {a, b, c}) normals_[point] = normals_[point] + normal;
  }
}

bool RayScene::meet(Vec3f origin, Vec3f direction, float from, Hit& hit) const {
  RTCRayHit query;
  fill(query.ray, origin, direction, from, std::numeric_limits<float>::infinity());
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect1(scene_.get(), &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  hit.depth = query.ray.tfar;
  hit.index = query.hit.primID;
  hit.is_line = query.hit.geomID == lines_;
  Vec3f normal = unit({query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z});
  const auto faces_away = [&](Vec3f of) { return dot(of, direction) > 0; };
  if (!hit.is_line && !normals_.empty() && is_smooth_[hit.index]) {
    const auto& [a, b, c] = triangles_[hit.index];
    const Vec3f smooth = (1 - query.hit.u - query.hit.v) * normals_[a] + query.hit.u * normals_[b] +
                         query.hit.v * normals_[c];
    if (dot(smooth, smooth) > 0) normal = unit(smooth);
  }
  hit.normal = faces_away(normal) ? -1.0F * normal : normal;
  return true;
}

bool RayScene::is_blocked(Vec3f origin, Vec3f direction, float from, float to) const {
  RTCRay ray;
  fill(ray, origin, direction, from, to);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene_.get(), &context, &ray);
  return ray.tfar < 0;
}

}  // namespace hyperlattice::render
