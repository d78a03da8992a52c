// A renderer in two passes. The first pass finds the particle and the depth that each pixel sees,
// from the nearest particle to the farthest. The second pass computes the light of each pixel once.
// The picture has twice as many pixels along each axis and is averaged, which smooths edges.
//   light    = colour * (ambient * openness + lamp * max(0, n.l))
//   openness = 1 - s sum max(0, v.n - b) / (v.v + e)
// with the vectors v from the pixel's point to nearby visible points. Points above the surface make
// it darker, so cracks and steps are dark.
#include "render.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hyperlattice::picture {
namespace {

constexpr int fineness = 2;
constexpr float far_away = 1e30f;
constexpr std::uint32_t nobody = ~std::uint32_t{0};

struct Vec3f {
  float x = 0, y = 0, z = 0;
};
float dot(Vec3f a, Vec3f b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec3f narrow(Vec3 a) {
  return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
}

struct Hit {
  float depth = far_away;
  Vec3f normal;
};

/// A cube of half width h in view space; meet() intersects it with the ray of the pixel (X, Y).
struct Cube {
  Vec3f axes[3];
  float h = 0, k = 0;
  Vec3f reach;  ///< half extents of the bounding box

  Cube(const Camera& camera, float half, float slope) : h(half), k(slope) {
    const Vec3 world[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int n = 0; n < 3; ++n) {
      const Vec3f a = axes[n] =
          narrow({hyperlattice::dot(world[n], camera.right), hyperlattice::dot(world[n], camera.up),
                  hyperlattice::dot(world[n], camera.forward)});
      reach = {reach.x + h * std::abs(a.x), reach.y + h * std::abs(a.y),
               reach.z + h * std::abs(a.z)};
    }
  }

  Hit meet(Vec3f centre, float X, float Y) const {
    const Vec3f to{centre.x - X * (1 + k * centre.z), centre.y - Y * (1 + k * centre.z), 0},
        ray{k * X, k * Y, 1};
    float enter = -far_away, leave = far_away;
    Hit hit;
    for (const Vec3f& axis : axes) {
      const float along = dot(axis, ray);
      const float inverse = 1 / (std::abs(along) > 1e-6f ? along : 1e-6f);
      const float middle = dot(axis, to) * inverse, half = h * std::abs(inverse);
      if (middle - half > enter) {
        enter = middle - half;
        const float side = along > 0 ? -1.0f : 1.0f;
        hit.normal = {side * axis.x, side * axis.y, side * axis.z};
      }
      leave = std::min(leave, middle + half);
    }
    if (enter <= leave) hit.depth = centre.z + enter;
    return hit;
  }
};

struct Sphere {
  float h = 0, k = 0;
  Vec3f reach;

  Sphere(const Camera&, float half, float slope) : h(half), k(slope), reach{half, half, half} {}

  Hit meet(Vec3f centre, float X, float Y) const {
    const Vec3f to{centre.x - X * (1 + k * centre.z), centre.y - Y * (1 + k * centre.z), 0},
        ray{k * X, k * Y, 1};
    const float square = dot(ray, ray), along = dot(ray, to),
                inside = along * along - square * (dot(to, to) - h * h);
    if (inside < 0) return {};
    const float t = (along - std::sqrt(inside)) / square;
    return {centre.z + t, {(t * ray.x - to.x) / h, (t * ray.y - to.y) / h, (t * ray.z - to.z) / h}};
  }
};

/// The depth and the particle that each fine pixel sees.
struct Canvas {
  int width, height;
  float left, top;  ///< view coordinates of the first fine pixel's centre
  std::vector<float> depth;
  std::vector<std::uint32_t> owner;

  Canvas(const Image& image, const Camera& camera)
      : width(fineness * image.width),
        height(fineness * image.height),
        left(static_cast<float>(0.5 - fineness * camera.x)),
        top(static_cast<float>(fineness * camera.y - 0.5)),
        depth(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), far_away),
        owner(depth.size(), nobody) {}
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(column);
  }
  float x(int column) const { return left + static_cast<float>(column); }
  float y(int row) const { return top - static_cast<float>(row); }
};

/// Returns the indices of particles from the nearest to the farthest, sorted by 4096 slices of
/// depth.
std::vector<std::uint32_t> front_to_back(const std::vector<Vec3f>& centres) {
  constexpr std::size_t slices = 4096;
  const auto [nearest, farthest] = std::minmax_element(centres.begin(), centres.end(),
                                                       [](Vec3f a, Vec3f b) { return a.z < b.z; });
  const float low = nearest->z,
              scale = static_cast<float>(slices - 1) / std::max(farthest->z - low, 1e-20f);
  const auto slice = [&](Vec3f c) {
    const float place = (c.z - low) * scale;
    return place > 0 ? static_cast<std::size_t>(std::min(place, static_cast<float>(slices - 1)))
                     : 0;  // a depth that is not a number counts as nearest
  };
  std::vector<std::uint32_t> first(slices + 1, 0), order(centres.size());
  for (const Vec3f& c : centres) ++first[slice(c) + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  for (std::uint32_t n = 0; n < centres.size(); ++n) order[first[slice(centres[n])]++] = n;
  return order;
}

/// Returns whether any pixel of the row sees something farther than `limit`, or nothing.
bool any_farther(const float* depth, int count, float limit) {
  int farther = 0;
  for (int n = 0; n < count; ++n) farther |= depth[n] > limit ? 1 : 0;
  return farther != 0;
}

template <class Form>
void draw(const Form& form, Vec3f centre, std::uint32_t particle, Canvas& canvas) {
  const float nearer = 1 / (1 + form.k * centre.z), front = centre.z - form.reach.z;
  const float grow = 1 / std::max(1 + form.k * front, 1e-3f);  // magnification of the front
  const float x = centre.x * nearer - canvas.left, y = canvas.top - centre.y * nearer;
  const float dx = form.reach.x * grow + std::abs(centre.x) * (grow - nearer) + 1,
              dy = form.reach.y * grow + std::abs(centre.y) * (grow - nearer) + 1;
  if (!(x + dx > 0 && x - dx < static_cast<float>(canvas.width) && y + dy > 0 &&
        y - dy < static_cast<float>(canvas.height)))
    return;
  const int left = static_cast<int>(std::max(0.0f, x - dx)),
            right = static_cast<int>(std::min(static_cast<float>(canvas.width), x + dx + 1));
  const int top = static_cast<int>(std::max(0.0f, y - dy)),
            bottom = static_cast<int>(std::min(static_cast<float>(canvas.height), y + dy + 1));
  for (int row = top; row < bottom; ++row) {
    float* depth = &canvas.depth[canvas.index(0, row)];
    if (!any_farther(depth + left, right - left, front)) continue;
    std::uint32_t* owner = &canvas.owner[canvas.index(0, row)];
    for (int column = left; column < right; ++column) {
      const float met = form.meet(centre, canvas.x(column), canvas.y(row)).depth;
      if (met >= depth[column]) continue;
      depth[column] = met;
      owner[column] = particle;
    }
  }
}

/// The openness of a visible point, 0 to 1: 1 if no nearby point stands above its surface.
class Openness {
 public:
  Openness(const Canvas& canvas, float particle, float k)
      : canvas_(canvas), particle_(particle), k_(k) {
    for (int n = 0; n < turns * samples;
         ++n) {  // four spirals, each turned a little more, for four neighbouring pixels
      const int spiral = n / samples, step = n % samples;
      const double radius = 2.5 * particle * std::pow((step + 0.5) / samples, 0.75);
      const double angle = 2.399963 * step + 6.283185 * spiral / turns / samples * 5;
      offsets_[n] = {static_cast<int>(std::lround(radius * std::cos(angle))),
                     static_cast<int>(std::lround(radius * std::sin(angle)))};
    }
  }

  float at(int column, int row, const Hit& hit) const {
    const float bias = 0.02f * particle_, soft = 0.05f * particle_ * particle_;
    const Offset* offsets = &offsets_[((column & 1) + 2 * (row & 1)) * samples];
    float shade = 0;
    for (int n = 0; n < samples; ++n) {
      const int c = column + offsets[n].x, r = row + offsets[n].y;
      if (c < 0 || r < 0 || c >= canvas_.width || r >= canvas_.height) continue;
      const float depth = canvas_.depth[canvas_.index(c, r)];
      if (depth >= far_away) continue;
      const float stretch = 1 + k_ * depth, here = 1 + k_ * hit.depth;
      const Vec3f v{canvas_.x(c) * stretch - canvas_.x(column) * here,
                    canvas_.y(r) * stretch - canvas_.y(row) * here, depth - hit.depth};
      shade += std::max(0.0f, dot(v, hit.normal) - bias) / (dot(v, v) + soft);
    }
    return std::clamp(1 - 1.3f * particle_ * shade / static_cast<float>(samples), 0.0f, 1.0f);
  }

 private:
  static constexpr int samples = 14, turns = 4;
  struct Offset {
    int x = 0, y = 0;
  };
  const Canvas& canvas_;
  float particle_, k_;
  Offset offsets_[samples * turns];
};

struct Light {
  float red = 0, green = 0, blue = 0;
};
float linear(std::uint8_t value) {
  return static_cast<float>(value) * static_cast<float>(value) / 65025.0f;
}  // a screen's value is about the square root of the light
std::uint8_t screen(float light) {
  return static_cast<std::uint8_t>(std::lround(255 * std::sqrt(std::clamp(light, 0.0f, 1.0f))));
}

template <class Form>
void paint(const Form& form, const std::vector<Vec3f>& centres, std::span<const Colour> colours,
           const Canvas& canvas, Image& image) {
  const Openness openness(canvas, 2 * form.h, form.k);
  const Vec3f lamp{-0.42f, 0.61f, -0.67f};  // over the viewer's left shoulder
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      Light sum;
      for (int part = 0; part < fineness * fineness; ++part) {
        const int column = fineness * x + part % fineness, row = fineness * y + part / fineness;
        const std::uint32_t owner = canvas.owner[canvas.index(column, row)];
        if (owner == nobody) {
          sum = {sum.red + 1, sum.green + 1, sum.blue + 1};
          continue;
        }
        const Hit hit = form.meet(centres[owner], canvas.x(column), canvas.y(row));
        const float open = openness.at(column, row, hit),
                    lit = std::max(0.0f, dot(hit.normal, lamp));
        const float light =
            open * (0.42f + 0.12f * hit.normal.y) + (0.35f + 0.65f * open) * 0.85f * lit;
        const Colour colour = colours[owner];
        sum = {sum.red + light * linear(colour[0]), sum.green + light * linear(colour[1]),
               sum.blue + light * linear(colour[2])};
      }
      constexpr float share = 1.0f / (fineness * fineness);
      image.at(x, y) = {screen(share * sum.red), screen(share * sum.green),
                        screen(share * sum.blue)};
    }
}

template <class Form>
void render_as(const Particles& particles, const Camera& camera, Image& image) {
  std::vector<Vec3f> centres(particles.colours.size());
  for (std::size_t n = 0; n < centres.size(); ++n) {
    const double* p = &particles.positions[3 * n];
    centres[n] = narrow(fineness * camera.to_view({p[0], p[1], p[2]}));
  }
  const Form form(camera, static_cast<float>(0.5 * fineness * camera.scale * particles.size),
                  static_cast<float>(camera.k / fineness));
  Canvas canvas(image, camera);
  for (const std::uint32_t particle : front_to_back(centres))
    if (const Vec3f& c = centres[particle]; 1 + form.k * (c.z - form.reach.z) > 0.05f)
      draw(form, c, particle, canvas);  // only particles in front of the eye
  paint(form, centres, particles.colours, canvas, image);
}

}  // namespace

double render_bytes(double pixels, double particles) {
  return pixels * fineness * fineness * (sizeof(float) + sizeof(std::uint32_t)) +
         particles * (sizeof(Vec3f) + sizeof(std::uint32_t));
}

void render(const Particles& particles, const Camera& camera, Image& image) {
  if (particles.colours.empty()) return;
  if (particles.form == Form::cubes)
    render_as<Cube>(particles, camera, image);
  else
    render_as<Sphere>(particles, camera, image);
}

}  // namespace hyperlattice::picture
