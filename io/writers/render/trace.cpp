#include "trace.hpp"

#include <algorithm>
#include <cmath>

namespace hyperlattice::render {

namespace {

using picture::Colour;

/// Light of a screen's pixel: about the square of its number. `cover`: how much of the background
/// it hides.
struct Light {
  float red = 0, green = 0, blue = 0, cover = 0;

  void add(float share, Light other) {
    red += share * other.red;
    green += share * other.green;
    blue += share * other.blue;
    cover += share * other.cover;
  }
};

Light light_of(Colour colour, float brightness) {
  const auto square = [&](std::uint8_t value) {
    return brightness * static_cast<float>(value) * static_cast<float>(value) / 65025.0F;
  };
  return {square(colour[0]), square(colour[1]), square(colour[2]), 1};
}

std::uint32_t byte(float share) {
  return static_cast<std::uint32_t>(std::lround(255 * std::clamp(share, 0.0F, 1.0F)));
}

/// Returns the pixel of a mean light. On white the colour is opaque.
std::uint32_t pixel_of(Light light, bool is_transparent) {
  const float cover = std::clamp(light.cover, 0.0F, 1.0F), white = is_transparent ? 0 : 1 - cover;
  const float alpha = is_transparent ? cover : 1;
  if (alpha == 0) return 0;
  const auto channel = [&](float value) {
    return byte(alpha * std::sqrt(std::max(0.0F, (value + white) / alpha)));
  };
  return byte(alpha) << 24 | channel(light.red) << 16 | channel(light.green) << 8 |
         channel(light.blue);
}

class Tracer {
 public:
  Tracer(const RayScene& scene, const Look& look, const picture::Camera& camera)
      : scene_(scene), look_(look), camera_(camera), k_(static_cast<float>(camera.k)) {}

  /// Returns the mean light of a pixel.
  Light pixel(int x, int y) const {
    const int n = look_.samples, first = std::min(n, 2);
    // Where four samples see the same flat part, the others would see it too.
    Light sum;
    Seen seen, corner;
    bool is_same = true;
    for (int row = 0; row < first; ++row)
      for (int column = 0; column < first; ++column) {
        sum.add(1, sample(x, y, column, row, first, corner));
        if (row + column == 0) seen = corner;
        is_same = is_same && corner == seen;
      }
    if (n <= 2 || is_same) return mean(sum, first * first);
    sum = {};
    for (int row = 0; row < n; ++row)
      for (int column = 0; column < n; ++column) sum.add(1, sample(x, y, column, row, n, corner));
    return mean(sum, n * n);
  }

 private:
  /// What a ray sees first.
  struct Seen {
    std::uint32_t particle = ~0U;  ///< or nothing
    Vec3f normal;
    bool is_layer = false;  ///< a crack or a line, or something transparent

    bool operator==(const Seen& other) const {
      constexpr float alike = 0.999F;
      return !is_layer && !other.is_layer && particle == other.particle &&
             (particle == ~0U || dot(normal, other.normal) > alike);
    }
  };

  static Light mean(Light sum, int count) {
    Light light;
    light.add(1 / static_cast<float>(count), sum);
    return light;
  }

  /// Returns the light of sample (column, row) of n by n in a pixel.
  Light sample(int x, int y, int column, int row, int n, Seen& seen) const {
    const float X = static_cast<float>(x + (column + 0.5) / n - camera_.x),
                Y = static_cast<float>(camera_.y - (y + (row + 0.5) / n));
    // The ray of a camera, from the eye or from before the first surface.
    const float start =
        k_ > 0 ? std::max(scene_.nearest() - 1, -0.999F / k_) : scene_.nearest() - 1;
    const Vec3f direction{k_ * X, k_ * Y, 1}, origin = Vec3f{X, Y, 0} + start * direction;
    constexpr int most_surfaces = 256;
    constexpr float least_left = 1e-3F;
    const float turn = (static_cast<float>(row * n + column) + 0.5F) / static_cast<float>(n * n);
    Light light;
    float left = 1, from = 0;
    seen = {};
    for (int surface = 0; surface < most_surfaces && left > least_left; ++surface) {
      Hit hit;
      if (!scene_.meet(origin, direction, from, hit)) break;
      const Triangle* triangle = hit.is_line ? nullptr : &look_.triangles[hit.index];
      const bool is_layer =
          hit.is_line || (triangle->part == Part::crack && look_.has_crack_colour);
      const float opacity = is_layer ? 1 : static_cast<float>(look_.opacity);
      if (surface == 0)
        seen = {is_layer ? 0 : triangle->particle, hit.normal, is_layer || opacity < 1};
      const Colour colour =
          hit.is_line ? look_.lines[hit.index].is_open ? look_.open_line : look_.closed_line
          : is_layer  ? look_.crack
                      : look_.particles[triangle->particle];
      const float brightness =
          look_.light > 0 ? brightness_of(origin + hit.depth * direction, hit.normal, turn) : 1;
      light.add(left * opacity, light_of(colour, brightness));
      left *= 1 - opacity;
      from = hit.depth + 1e-4F * (1 + std::abs(hit.depth));
    }
    return light;
  }

  /// Returns 1 for a surface in full light.
  float brightness_of(Vec3f at, Vec3f normal, float turn) const {
    const Vec3f lamp = unit({-0.42F, 0.61F, -0.95F});  // over the viewer's left shoulder
    const float lit = std::max(0.0F, dot(normal, lamp)), open = openness(at, normal, turn);
    const float full = std::min(1.0F, 0.38F * open + (0.35F + 0.65F * open) * 0.66F * lit);
    return 1 - static_cast<float>(look_.light) * (1 - full);
  }

  /// Returns the share of the directions away from a surface in which nothing is near, each
  /// weighted by its cosine with the normal (ambient occlusion). `turn`, 0 to 1: the samples of a
  /// pixel look along different directions, and all pixels along the same, so that there is no
  /// noise.
  float openness(Vec3f at, Vec3f normal, float turn) const {
    if (!(look_.opacity == 1 && look_.shade_reach > 0)) return 1;
    constexpr int rays = 8;
    constexpr float golden = 0.61803399F, circle = 6.2831853F;
    const auto reach = static_cast<float>(look_.shade_reach);
    const Vec3f helper = std::abs(normal.x) < 0.6F ? Vec3f{1, 0, 0} : Vec3f{0, 1, 0};
    const Vec3f u = unit(cross(helper, normal)), v = cross(normal, u);
    const Vec3f start = at + 0.01F * reach * normal;
    int open = 0;
    for (int n = 0; n < rays; ++n) {
      const float part = static_cast<float>(n) + turn, square = part / rays,
                  angle = circle * golden * part;
      const float across = std::sqrt(square), along = std::sqrt(1 - square);
      const Vec3f direction =
          across * std::cos(angle) * u + across * std::sin(angle) * v + along * normal;
      if (!scene_.is_blocked(start, direction, 0, reach)) ++open;
    }
    return static_cast<float>(open) / rays;
  }

  const RayScene& scene_;
  const Look& look_;
  const picture::Camera& camera_;
  float k_;
};

/// Returns how dark the outline is at a pixel, 0 to 1: three times the share of the background in
/// the disc of this radius around it. `full`: cover of a pixel inside.
float outline_at(const std::vector<Light>& lights, int width, int height, int x, int y, int radius,
                 float full) {
  float covered = 0;
  int count = 0;
  for (int row = std::max(0, y - radius); row <= std::min(height - 1, y + radius); ++row)
    for (int column = std::max(0, x - radius); column <= std::min(width - 1, x + radius);
         ++column) {
      if ((column - x) * (column - x) + (row - y) * (row - y) > radius * radius) continue;
      const Light& light = lights[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                                  static_cast<std::size_t>(column)];
      covered += std::min(1.0F, light.cover / full);
      ++count;
    }
  return std::clamp(3 * (1 - covered / static_cast<float>(count)), 0.0F, 1.0F);
}

}  // namespace

Raster trace(const Snapshot& snapshot, const RayScene& scene, const Look& look,
             const picture::Camera& camera, int width, int height, picture::Frame area) {
  constexpr int band = 8;           // rows of a task
  constexpr float darkest = 0.85F;  // how much of the light the outline takes
  const auto index = [width](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  };
  const auto for_pixels = [&](const auto& visit) {
    snapshot.for_each(static_cast<std::uint64_t>((height + band - 1) / band), [&](std::uint64_t n) {
      const int top = static_cast<int>(n) * band;
      for (int y = top; y < std::min(height, top + band); ++y)
        for (int x = 0; x < width; ++x) visit(x, y);
    });
  };
  std::vector<Light> lights(index(0, height));
  const Tracer tracer(scene, look, camera);
  const auto is_in_area = [&](double x, double y) {
    return x >= area.left && x < area.left + area.width && y >= area.top &&
           y < area.top + area.height;
  };
  for_pixels([&](int x, int y) {
    if (is_in_area(x + 0.5, y + 0.5)) lights[index(x, y)] = tracer.pixel(x, y);
  });
  Raster raster{width, height, {}};
  raster.pixels.resize(lights.size());
  const int radius = std::max(2, width / 500);
  const auto full = static_cast<float>(look.opacity);
  for_pixels([&](int x, int y) {
    Light light = lights[index(x, y)];
    if (look.has_outline && light.cover > 0) {
      const float left = 1 - darkest * outline_at(lights, width, height, x, y, radius, full);
      light = {left * light.red, left * light.green, left * light.blue, light.cover};
    }
    raster.pixels[index(x, y)] = pixel_of(light, look.is_transparent);
  });
  return raster;
}

}  // namespace hyperlattice::render
