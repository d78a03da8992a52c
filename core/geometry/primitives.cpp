#include <base/input_file.hpp>
#include <geometry/primitives.hpp>
#include <geometry/triangle_mesh.hpp>
#include <geometry/voxel_image.hpp>

#include <algorithm>
#include <array>
#include <numbers>

namespace hyperlattice {

namespace {

constexpr double pi = std::numbers::pi;

Region solid(Vec3 low, Vec3 high, Vec3 anchor, Vec3 centre, std::function<bool(Vec3)> inside) {
  Region region;
  region.kind = Region::Kind::solid;
  region.inside = std::move(inside);
  region.low = low;
  region.high = high;
  region.anchor = anchor;
  region.centre = centre;
  return region;
}

/// The planes of a box.
std::vector<SolidSurface> sides_of(Vec3 low, Vec3 high) {
  return {{low, {-1, 0, 0}}, {high, {1, 0, 0}}, {low, {0, -1, 0}},
          {high, {0, 1, 0}}, {low, {0, 0, -1}}, {high, {0, 0, 1}}};
}

SolidSurface sphere_around(Vec3 centre, double radius, bool is_cavity = false) {
  return {centre, {}, radius, is_cavity};
}

/// A box with edges along the axes, given by two corners or by centre and size.
struct Box {
  struct Options {
    std::optional<Vec3> low, high, centre, size;
  };
  static Schema<Options> schema() {
    return Schema<Options>("box",
                           "Box with edges along the axes, by two corners or by centre and size")
        .add<&Options::low>("low", "m", "corner with the smallest coordinates")
        .add<&Options::high>("high", "m", "corner with the largest coordinates")
        .add<&Options::centre>("centre", "m", "centre, with size; the origin if left out")
        .add<&Options::size>("size", "m", "lengths of the edges")
        .positive()
        .check([](const Options& box, const FaultSink& faults) {
          if (box.size) {
            if (box.low || box.high)
              faults.fault("size", "either low and high, or centre and size, not both");
          } else if (!box.low || !box.high || box.centre) {
            faults.fault("", "a box by low and high, or by centre and size");
          } else if (!(box.low->x < box.high->x && box.low->y < box.high->y &&
                       box.low->z < box.high->z)) {
            faults.fault("high", "a corner above low in every coordinate");
          }
        });
  }
  static Region make(const Options& box) {
    const Vec3 middle = box.centre.value_or(Vec3{});
    const Vec3 low = box.size ? middle - 0.5 * *box.size : *box.low,
               high = box.size ? middle + 0.5 * *box.size : *box.high;
    Region region = solid(low, high, low, 0.5 * (low + high), [low, high](Vec3 p) {
      return low.x <= p.x && p.x <= high.x && low.y <= p.y && p.y <= high.y && low.z <= p.z &&
             p.z <= high.z;
    });
    region.surfaces = sides_of(low, high);
    const Vec3 edge = high - low;
    region.volume = edge.x * edge.y * edge.z;
    region.outer_area = 2 * (edge.x * edge.y + edge.y * edge.z + edge.z * edge.x);
    return region;
  }
};

struct Sphere {
  struct Options {
    Vec3 centre;
    double radius = 0;
  };
  static Schema<Options> schema() {
    return Schema<Options>("sphere", "Ball")
        .add<&Options::centre>("centre", "m", "centre")
        .fallback("[0, 0, 0]")
        .add<&Options::radius>("radius", "m", "radius")
        .positive();
  }
  static Region make(const Options& sphere) {
    const Vec3 c = sphere.centre;
    const double r = sphere.radius;
    Region region = solid(c - Vec3{r, r, r}, c + Vec3{r, r, r}, c, c,
                          [c, r](Vec3 p) { return dot(p - c, p - c) <= r * r; });
    region.surfaces = {sphere_around(c, r)};
    region.volume = 4 * pi / 3 * r * r * r;
    region.outer_area = 4 * pi * r * r;
    return region;
  }
};

struct HollowSphere {
  struct Options {
    Vec3 centre;
    double inner_radius = 0, outer_radius = 0;
  };
  static Schema<Options> schema() {
    return Schema<Options>("hollow_sphere", "Ball with a round cavity in its middle")
        .add<&Options::centre>("centre", "m", "centre")
        .fallback("[0, 0, 0]")
        .add<&Options::inner_radius>("inner_radius", "m", "radius of the cavity")
        .positive()
        .add<&Options::outer_radius>("outer_radius", "m", "radius of the ball")
        .positive()
        .check([](const Options& sphere, const FaultSink& faults) {
          if (sphere.outer_radius <= sphere.inner_radius)
            faults.fault("outer_radius", "a radius above inner_radius");
        });
  }
  static Region make(const Options& sphere) {
    const Vec3 c = sphere.centre;
    const double a = sphere.inner_radius, b = sphere.outer_radius;
    Region region = solid(c - Vec3{b, b, b}, c + Vec3{b, b, b}, c, c, [c, a, b](Vec3 p) {
      const double square = dot(p - c, p - c);
      return a * a <= square && square <= b * b;
    });
    region.surfaces = {sphere_around(c, b), sphere_around(c, a, true)};
    region.volume = 4 * pi / 3 * (b * b * b - a * a * a);
    region.outer_area = 4 * pi * b * b;
    region.inner_area = 4 * pi * a * a;
    return region;
  }
};

/// The anchor is the start of the axis, so that whole cells fill the length of an upright cylinder
/// exactly.
struct Cylinder {
  struct Options {
    Vec3 start, end;
    double radius = 0;
  };
  static Schema<Options> schema() {
    return Schema<Options>("cylinder", "Round cylinder between two points of its axis")
        .add<&Options::start>("start", "m", "one end of the axis")
        .add<&Options::end>("end", "m", "other end of the axis")
        .add<&Options::radius>("radius", "m", "radius")
        .positive()
        .check([](const Options& cylinder, const FaultSink& faults) {
          if (cylinder.start == cylinder.end) faults.fault("end", "a point other than start");
        });
  }
  static Region make(const Options& cylinder) {
    const Vec3 start = cylinder.start, axis = cylinder.end - start;
    const double length = norm(axis), r = cylinder.radius;
    const Vec3 d = (1 / length) * axis;
    const auto reach = [r](double cosine) {
      return r * std::sqrt(std::max(0.0, 1 - cosine * cosine));
    };
    const Vec3 wide{reach(d.x), reach(d.y), reach(d.z)};
    const Vec3 low{std::fmin(start.x, cylinder.end.x), std::fmin(start.y, cylinder.end.y),
                   std::fmin(start.z, cylinder.end.z)};
    const Vec3 high{std::fmax(start.x, cylinder.end.x), std::fmax(start.y, cylinder.end.y),
                    std::fmax(start.z, cylinder.end.z)};
    Region region =
        solid(low - wide, high + wide, start, start + 0.5 * axis, [start, d, length, r](Vec3 p) {
          const double along = dot(p - start, d);
          const Vec3 across = p - start - along * d;
          return 0 <= along && along <= length && dot(across, across) <= r * r;
        });
    region.surfaces = {{start, d, r}, {start, -d}, {cylinder.end, d}};
    region.volume = pi * r * r * length;
    return region;
  }
};

/// An unbounded solid, to cut other solids and for regions.
struct HalfSpace {
  struct Options {
    Vec3 point, normal;
  };
  static Schema<Options> schema() {
    return Schema<Options>("half_space",
                           "Everything on one side of a plane: where (x - point) . normal <= 0")
        .add<&Options::point>("point", "m", "a point of the plane")
        .fallback("[0, 0, 0]")
        .add<&Options::normal>("normal", "",
                               "direction that points out of the half-space, of any length")
        .check([](const Options& half, const FaultSink& faults) {
          if (half.normal == Vec3{}) faults.fault("normal", "a direction other than [0, 0, 0]");
        });
  }
  static Region make(const Options& half) {
    const Vec3 point = half.point, n = scaled(half.normal);
    Vec3 low{-infinity, -infinity, -infinity}, high{infinity, infinity, infinity};
    const auto bound = [](double normal, double at, double& below, double& above) {
      (normal > 0 ? above : below) = at;
    };
    if (n.y == 0 && n.z == 0) bound(n.x, point.x, low.x, high.x);
    if (n.z == 0 && n.x == 0) bound(n.y, point.y, low.y, high.y);
    if (n.x == 0 && n.y == 0) bound(n.z, point.z, low.z, high.z);
    Region region =
        solid(low, high, point, point, [point, n](Vec3 p) { return dot(p - point, n) <= 0; });
    region.surfaces = {{point, n / norm(n)}};
    return region;
  }
};

/// The solid within a closed surface of triangles.
struct Stl {
  static constexpr std::string_view file_holds = "a closed surface";
  struct Options {
    std::string file;
    double scale = 1;
  };
  static Schema<Options> schema() {
    return Schema<Options>("stl",
                           "Solid bounded by the facets of an STL file, ASCII or binary; its "
                           "surface must be closed")
        .add<&Options::file>(path_option, "", "the file, relative to the scene")
        .file()
        .add<&Options::scale>(
            "scale", "m", "what a length of 1 in the file is: \"1 mm\" for a file in millimetres")
        .positive()
        .fallback("1");
  }
  static Region make(const Options& stl) {
    TriangleMesh mesh = read_stl(read_input_file(stl.file, "", "an STL file"), stl.scale);
    const std::string fault = solid_fault(mesh);
    if (!fault.empty() && !sections_are_solids(mesh)) throw std::runtime_error(fault);
    // areas are unknown if solids touch
    const SurfaceAreas areas = fault.empty() ? surface_areas(mesh) : SurfaceAreas();
    const auto inside = std::make_shared<const InsideTest>(std::move(mesh));
    if (const std::string turned = orientation_fault(*inside); !turned.empty())
      throw std::runtime_error(turned);
    const Vec3 low = inside->low(), high = inside->high();
    Region region =
        solid(low, high, low, 0.5 * (low + high), [inside](Vec3 p) { return (*inside)(p); });
    region.facets = inside;
    region.outer_area = areas.outer;
    region.inner_area = areas.inner;
    return region;
  }
};

/// The solid in an image. The anchor is the image's corner, so that cells of the voxels' size
/// coincide with the voxels.
struct Voxels {
  static constexpr std::string_view file_holds = "such an image";
  struct Options {
    std::string file;
    Vec3 counts, low;
    double voxel = 0;
    VoxelType type = VoxelType::uint8;
    std::vector<double> values;
  };
  static constexpr std::string_view type_names[] = {"uint8", "uint16"};
  static Schema<Options> schema() {
    return Schema<Options>("voxels",
                           "Voxels of an image that have one of some values: raw numbers without a "
                           "header, x running fastest, then y, then z")
        .add<&Options::file>(path_option, "", "the file, relative to the scene")
        .file()
        .add<&Options::counts>("counts", "", "voxels along x, y and z; whole numbers")
        .at_least(1)
        .at_most(1e5)
        .example("[1, 1, 1]")
        .add<&Options::voxel>("voxel", "m", "edge of a voxel, a cube")
        .positive()
        .add<&Options::low>("low", "m", "where the image's corner with the smallest coordinates is")
        .fallback("[0, 0, 0]")
        .add<&Options::type>("type", "", "of a number: one byte, or two, little-endian")
        .choices(type_names)
        .fallback("\"uint8\"")
        .add<&Options::values>("values", "", "values of the voxels inside; left out: all but 0")
        .fallback("[]")
        .check([](const Options& image, const FaultSink& faults) {
          for (const double count : {image.counts.x, image.counts.y, image.counts.z})
            if (count != std::floor(count))
              return faults.fault("counts", "whole numbers of voxels");
          const double largest = image.type == VoxelType::uint8 ? 255 : 65535;
          for (const double value : image.values)
            if (!(value >= 0 && value <= largest && value == std::floor(value)))
              return faults.fault(
                  "values", "whole numbers from 0 to " + std::to_string(static_cast<int>(largest)));
        });
  }
  static Region make(const Options& image) {
    const auto count = [](double number) { return static_cast<std::int64_t>(number); };
    const auto set = std::make_shared<const VoxelSet>(
        read_input_file(image.file, "", "a voxel image"),
        std::array{count(image.counts.x), count(image.counts.y), count(image.counts.z)}, image.type,
        image.values, image.low, image.voxel);
    Region region = solid(set->low(), set->high(), image.low, 0.5 * (set->low() + set->high()),
                          [set](Vec3 p) { return set->contains(p); });
    region.facets = set;
    return region;
  }
};

template <class Solid>
Primitive describe() {
  static const auto schema = Solid::schema();
  Primitive primitive{
      schema.name(), schema.summary(), option_set<Solid>(), {}, [](const void* options) {
        Region region = Solid::make(*static_cast<const typename Solid::Options*>(options));
        region.primitive = schema.name();
        return region;
      }};
  if constexpr (requires { Solid::file_holds; }) primitive.file_holds = Solid::file_holds;
  return primitive;
}

}  // namespace

std::span<const Primitive> primitives() {
  static const std::array all{describe<Box>(),      describe<Sphere>(),    describe<HollowSphere>(),
                              describe<Cylinder>(), describe<HalfSpace>(), describe<Stl>(),
                              describe<Voxels>()};
  return all;
}

}  // namespace hyperlattice
