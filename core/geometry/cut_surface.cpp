#include <base/csv.hpp>
#include <base/input_file.hpp>
#include <geometry/cut_surface.hpp>
#include <geometry/triangle_mesh.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace hyperlattice {

namespace {

FlatPiece plane_at(Vec3 point, Vec3 normal) {
  FlatPiece piece;
  piece.point = point;
  piece.normal = piece.moved_along = direction_of(normal);
  piece.low = {-infinity, -infinity, -infinity};
  piece.high = {infinity, infinity, infinity};
  return piece;
}

FlatPiece disc_at(Vec3 centre, Vec3 normal, double radius) {
  FlatPiece piece = plane_at(centre, normal);
  piece.outline = FlatPiece::Outline::circle;
  piece.radius = radius;
  const auto reach = [&](double cosine) {
    return radius * std::sqrt(std::max(0.0, 1 - cosine * cosine));
  };
  const Vec3 wide{reach(piece.normal.x), reach(piece.normal.y), reach(piece.normal.z)};
  piece.low = centre - wide;
  piece.high = centre + wide;
  return piece;
}

/// Returns the normal of a polygon with the length of its area, m2 (Newell's sum).
Vec3 area_vector(std::span<const Vec3> corners) {
  Vec3 sum;
  for (std::size_t n = 1; n + 1 < corners.size(); ++n)
    sum += 0.5 * cross(corners[n] - corners[0], corners[n + 1] - corners[0]);
  return sum;
}

FlatPiece polygon_of(std::vector<Vec3> corners, FlatPiece::Outline outline) {
  FlatPiece piece = plane_at(corners.front(), area_vector(corners));
  piece.outline = outline;
  piece.low = piece.high = corners.front();
  for (const Vec3 x : corners)
    for (int axis = 0; axis < 3; ++axis) {
      piece.low[axis] = std::min(piece.low[axis], x[axis]);
      piece.high[axis] = std::max(piece.high[axis], x[axis]);
    }
  piece.corners = std::move(corners);
  return piece;
}

/// Returns whether two edges of a polygon with this normal cross between their ends.
bool edges_cross(Vec3 a, Vec3 b, Vec3 c, Vec3 d, Vec3 normal) {
  const auto is_left = [normal](Vec3 from, Vec3 to, Vec3 x) {
    return dot(cross(to - from, x - from), normal) > 0;
  };
  return is_left(a, b, c) != is_left(a, b, d) && is_left(c, d, a) != is_left(c, d, b);
}

/// Throws std::runtime_error if the corners are no polygon.
void check_polygon(std::span<const Vec3> corners) {
  constexpr double flattest = 1e-6;  // over the size
  if (corners.size() < 3)
    throw std::runtime_error(fmt::format("there are {} corners", corners.size()));
  double size = 0;
  for (const Vec3 x : corners) size = std::max(size, norm(x - corners.front()));
  const Vec3 area = area_vector(corners);
  if (!(norm(area) > flattest * size * size))
    throw std::runtime_error("these have no area between them");
  const Vec3 normal = direction_of(area);
  for (std::size_t n = 0; n < corners.size(); ++n) {
    if (const double off = dot(corners[n] - corners.front(), normal);
        std::abs(off) > flattest * size)
      throw std::runtime_error(fmt::format(
          "corner {} is {:.3g} m off the plane of the others; cut with an stl sheet instead", n + 1,
          std::abs(off)));
    for (std::size_t m = n + 2; m < corners.size() && m + 1 < n + corners.size(); ++m)
      if (edges_cross(corners[n], corners[n + 1], corners[m], corners[(m + 1) % corners.size()],
                      normal))
        throw std::runtime_error(
            fmt::format("the edges from corner {} and from corner {} cross", n + 1, m + 1));
  }
}

/// Returns what a cell of a table holds. Throws std::runtime_error if it is no finite number.
double number_in(const CsvTable& table, std::size_t row, std::size_t column) {
  const auto number = csv_number(table.rows[row][column]);
  if (!number)
    throw std::runtime_error(fmt::format("line {}: a number was expected in the column \"{}\"",
                                         table.lines[row], table.columns[column]));
  return *number;
}

struct PlaneCut {
  struct Options {
    Vec3 point, normal;
  };
  static Schema<Options> schema() {
    return Schema<Options>("plane", "Endless plane")
        .add<&Options::point>("point", "m", "a point of the plane")
        .fallback("[0, 0, 0]")
        .add<&Options::normal>("normal", "", "direction across the plane, of any length")
        .nonzero();
  }
  static CutSurface make(const Options& o, std::span<const Vec3>) {
    return {{plane_at(o.point, o.normal)}, {}, false};
  }
};

struct DiscCut {
  struct Options {
    Vec3 centre, normal;
    double radius = 0;
  };
  static Schema<Options> schema() {
    return Schema<Options>("disc", "Flat round disc, such as a penny crack")
        .add<&Options::centre>("centre", "m", "centre")
        .fallback("[0, 0, 0]")
        .add<&Options::normal>("normal", "", "direction across the disc, of any length")
        .nonzero()
        .add<&Options::radius>("radius", "m", "radius")
        .positive();
  }
  static CutSurface make(const Options& o, std::span<const Vec3>) {
    return {{disc_at(o.centre, o.normal, o.radius)}, {}, false};
  }
};

struct PolygonCut {
  static constexpr bool has_corners = true;
  struct Options {};
  static Schema<Options> schema() { return Schema<Options>("polygon", "Flat polygon"); }
  static CutSurface make(const Options&, std::span<const Vec3> corners) {
    check_polygon(corners);
    return {{polygon_of({corners.begin(), corners.end()}, FlatPiece::Outline::polygon)}, {}, false};
  }
};

/// Many discs, such as the joints of a rock mass.
struct DiscsCut {
  static constexpr std::string_view file_holds =
      "the columns x, y, z, nx, ny, nz and radius, and a disc in each row";
  struct Options {
    std::string file;
    double scale = 1;
  };
  static Schema<Options> schema() {
    return Schema<Options>("discs", "List of discs, such as the joints of a rock mass")
        .add<&Options::file>("file", "",
                             "CSV file with the columns x, y, z of the centre, nx, ny, nz of a "
                             "normal of any length, and radius")
        .file()
        .add<&Options::scale>("scale", "m", "what a length of 1 in the file is")
        .positive()
        .fallback("1");
  }
  static CutSurface make(const Options& o, std::span<const Vec3>) {
    constexpr std::string_view names[] = {"x", "y", "z", "nx", "ny", "nz", "radius"};
    const std::string text = read_input_file(o.file, "", "a list of discs");
    const CsvTable table = parse_csv(text);
    std::array<std::size_t, std::size(names)> columns{};
    for (std::size_t n = 0; n < columns.size(); ++n) {
      const auto column = table.column(names[n]);
      if (!column) throw std::runtime_error(fmt::format("it has no column \"{}\"", names[n]));
      columns[n] = *column;
    }
    if (!table.faults.empty())
      throw std::runtime_error(
          fmt::format("line {}: {}", table.faults.front().line, table.faults.front().expected));
    if (table.rows.empty()) throw std::runtime_error("it has no discs");
    CutSurface surface;
    surface.is_list = true;
    surface.pieces.reserve(table.rows.size());
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
      const auto cell = [&](std::size_t n) { return number_in(table, row, columns[n]); };
      const Vec3 centre = o.scale * Vec3{cell(0), cell(1), cell(2)},
                 normal{cell(3), cell(4), cell(5)};
      const double radius = o.scale * cell(6);
      if (normal == Vec3{})
        throw std::runtime_error(fmt::format("line {}: the normal is [0, 0, 0]", table.lines[row]));
      if (!(radius > 0))
        throw std::runtime_error(
            fmt::format("line {}: the radius is not above 0", table.lines[row]));
      surface.pieces.push_back(disc_at(centre, normal, radius));
    }
    return surface;
  }
};

/// The facets of an STL file, open or closed.
struct SheetCut {
  static constexpr std::string_view file_holds = "a sheet of facets";
  struct Options {
    std::string file;
    double scale = 1;
  };
  static Schema<Options> schema() {
    return Schema<Options>("sheet",
                           "The facets of an STL file, ASCII or binary; the sheet need not be "
                           "closed")
        .add<&Options::file>("file", "", "the file, relative to the scene")
        .file()
        .add<&Options::scale>(
            "scale", "m", "what a length of 1 in the file is: \"1 mm\" for a file in millimetres")
        .positive()
        .fallback("1");
  }
  static CutSurface make(const Options& o, std::span<const Vec3>) {
    const TriangleMesh mesh = read_stl(read_input_file(o.file, "", "an STL file"), o.scale);
    CutSurface surface;
    Vec3 sum;
    double area = 0;
    for (const auto& facet : mesh.facets) {
      std::vector<Vec3> corners{mesh.points[facet[0]], mesh.points[facet[1]],
                                mesh.points[facet[2]]};
      const Vec3 own = area_vector(corners);
      if (norm(own) == 0) continue;
      sum += own;
      area += norm(own);
      surface.pieces.push_back(polygon_of(std::move(corners), FlatPiece::Outline::facet));
    }
    if (surface.pieces.empty()) throw std::runtime_error("its facets have no area");
    // Few facets are parallel to both parts of the direction.
    constexpr double least = 0.1;  // of the mean normal
    const Vec3 mean = norm(sum) > least * area ? direction_of(sum) : Vec3{};
    for (FlatPiece& piece : surface.pieces) piece.moved_along = mean + 0.1 * Vec3{0.48, 0.36, 0.8};
    return surface;
  }
};

/// The particles of a region and all others: bodies that touch.
struct BorderCut {
  struct Options {
    RegionId of;
  };
  static Schema<Options> schema() {
    return Schema<Options>("border",
                           "Where a region ends: no spring joins a particle of the region to "
                           "another one. For bodies that touch")
        .add<&Options::of>("of", "", "the region");
  }
  static CutSurface make(const Options& o, std::span<const Vec3>) { return {{}, o.of, false}; }
};

template <class Kind>
CutKind describe_cut() {
  static const auto schema = Kind::schema();
  CutKind kind{schema.name(),
               schema.summary(),
               option_set<Kind>(),
               {},
               false,
               [](const void* options, std::span<const Vec3> corners) {
                 return Kind::make(*static_cast<const typename Kind::Options*>(options), corners);
               }};
  if constexpr (requires { Kind::file_holds; }) kind.file_holds = Kind::file_holds;
  if constexpr (requires { Kind::has_corners; }) kind.has_corners = Kind::has_corners;
  return kind;
}

}  // namespace

std::span<const CutKind> cut_kinds() {
  static const std::array all{describe_cut<PlaneCut>(),   describe_cut<DiscCut>(),
                              describe_cut<PolygonCut>(), describe_cut<DiscsCut>(),
                              describe_cut<SheetCut>(),   describe_cut<BorderCut>()};
  return all;
}

}  // namespace hyperlattice
