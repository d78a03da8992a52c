// A lattice from files, for any structure: a packing, the nodes of a mesh, a scanned grain. A table
// of points gives the particles. A table of springs joins them; without this table, the shortest
// pairs are joined, as many as the mean coordination requires.
//   points:  columns x, y, z and, optionally, volume
//   springs: columns a, b and, optionally, stiffness (over k); a and b count the points from 0
#include <hyperlattice/files.hpp>
#include <hyperlattice/lattice.hpp>
#include <hyperlattice/neighbourhood.hpp>
#include <hyperlattice/tables.hpp>

#include <numeric>
#include <stdexcept>
#include <tuple>

namespace {
using namespace hyperlattice;

class Points {
 public:
  struct Options {
    std::string points;
    std::optional<std::string> springs;
    std::optional<double> coordination, spacing, particle_volume;
    double scale = 1;
    std::optional<const Shape*> shape;
  };

  static Schema<Options> schema() {
    return Schema<Options>("lattices.points", "Particles and springs from files")
        .equation(
            "springs: those of the file, or the coordination particles / 2 shortest pairs; Delta = "
            "spacing")
        .source("any structure: Zhao 2017, section 2.4, treats lattices whose points are random")
        .restrictions(
            "boundary particles only. Elastic constants are estimated as if all springs were "
            "strained alike, which makes E too large, by a tenth to "
            "a half for random points: give lambda in place of poisson, and compare with a test on "
            "the body. No two points stand at one place, and "
            "no two springs join the same points")
        .add<&Options::points>("points", "",
                               "CSV file with the columns x, y, z, times scale in metres, and "
                               "perhaps volume, times scale^3 in m3")
        .file()
        .add<&Options::springs>(
            "springs", "",
            "CSV file with the columns a, b, counting points from 0, and perhaps stiffness, over k")
        .file()
        .add<&Options::coordination>(
            "coordination", "",
            "in place of springs: mean number of springs of a particle, to the nearest")
        .at_least(1)
        .at_most(100)
        .add<&Options::scale>("scale", "m", "length of the files' unit")
        .positive()
        .fallback("1")
        .add<&Options::particle_volume>(
            "particle_volume", "m3",
            "of every particle, if the file has no volumes; left out: the cube of the spacing")
        .positive()
        .add<&Options::spacing>(
            "spacing", "m",
            "lattice constant, which is Delta too; left out: the mean length of the springs")
        .positive()
        .add<&Options::shape>("shape", "",
                              "the solid that the points stand for, for regions on its surface and "
                              "for its volume; left out: near to points")
        .check([](const Options& o, const FaultSink& faults) {
          if (o.springs.has_value() == o.coordination.has_value())
            faults.fault("springs", "one of springs and coordination");
        });
  }

  explicit Points(const Options& options) : o_(options) {}

  void build(const LatticeSink& sink) const {
    static constexpr std::string_view coordinates[] = {"x", "y", "z"}, volume[] = {"volume"};
    const NumberTable table(o_.points, coordinates, volume);
    const std::vector<Vec3> positions = positions_of(table);
    if (positions.size() < 2) throw std::invalid_argument("points with at least two particles");
    check_apart(table, positions);
    const std::vector<double> volumes = volumes_of(table);
    const std::vector<ListedSpring> springs =
        o_.springs ? springs_of_file(positions) : nearest_springs(positions);

    PointList list;
    list.positions = positions;
    list.volumes = volumes;
    list.springs = springs;
    const double length = mean_length(positions, springs);
    list.spacing = list.membrane_distance = o_.spacing.value_or(length);
    // The core reports springs whose length is zero in double precision.
    if (length > 0 && !(list.spacing >= length / most_apart && list.spacing <= length * most_apart))
      throw std::invalid_argument("spacing between " + short_number(length / most_apart) + " and " +
                                  short_number(length * most_apart) + " m, as the springs are " +
                                  short_number(length) + " m long in the mean: it is " +
                                  short_number(list.spacing) + " m");
    list.site_volume =
        o_.particle_volume.value_or(volumes.empty() ? std::pow(list.spacing, 3) : mean(volumes));
    list.shape = o_.shape.value_or(nullptr);
    sink.points(list);
  }

 private:
  static constexpr double most_apart = 20;  // ratio; the surface has cubes of half a spacing
  // m; products of a few lengths stay finite, and of the body's width above 0
  static constexpr double farthest = 1e50, narrowest = 1e-50;

  std::vector<Vec3> positions_of(const NumberTable& table) const {
    std::vector<Vec3> positions;
    positions.reserve(table["x"].size());
    for (std::size_t n = 0; n < table["x"].size(); ++n) {
      const Vec3 x = o_.scale * Vec3{table["x"][n], table["y"][n], table["z"][n]};
      for (const double along : {x.x, x.y, x.z})
        if (!(std::abs(along) <= farthest))
          table.refuse(n, "coordinates up to " + short_number(farthest) + " m, not " +
                              short_number(along) + " m, which is beyond what can be used");
      positions.push_back(x);
    }
    return positions;
  }

  /// Reports an input error if two points have the same position.
  static void check_apart(const NumberTable& table, const std::vector<Vec3>& positions) {
    std::vector<std::size_t> order(positions.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto place = [&](std::size_t n) {
      return std::tie(positions[n].x, positions[n].y, positions[n].z);
    };
    std::sort(order.begin(), order.end(), [&](std::size_t m, std::size_t n) {
      return place(m) != place(n) ? place(m) < place(n) : m < n;
    });
    std::size_t first = 0, second = positions.size();
    for (std::size_t n = 1; n < order.size(); ++n)
      if (place(order[n - 1]) == place(order[n]) && order[n] < second) {
        first = order[n - 1];
        second = order[n];
      }
    if (second < positions.size())
      table.refuse(second, "a point at a place of its own, not at that of line " +
                               std::to_string(table.line(first)));
  }

  std::vector<double> volumes_of(const NumberTable& table) const {
    std::vector<double> volumes = table["volume"];
    const double unit = o_.scale * o_.scale * o_.scale, most = farthest * farthest * farthest;
    for (std::size_t n = 0; n < volumes.size(); ++n) {
      if (!(volumes[n] > 0)) table.refuse(n, "a volume above 0, not " + short_number(volumes[n]));
      volumes[n] *= unit;
      if (!(volumes[n] > 0 && volumes[n] <= most))
        table.refuse(n, "a volume in reach of numbers, not " + short_number(table["volume"][n]) +
                            " times " + short_number(unit) + " m3");
    }
    return volumes;
  }

  std::vector<ListedSpring> springs_of_file(const std::vector<Vec3>& positions) const {
    static constexpr std::string_view ends[] = {"a", "b"}, more[] = {"stiffness"};
    const NumberTable table(*o_.springs, ends, more);
    const auto end = [&](std::string_view column, std::size_t n) {
      const double value = table[column][n];
      if (value != std::floor(value) || value < 0 || value >= static_cast<double>(positions.size()))
        table.refuse(n, "one of the " + std::to_string(positions.size()) +
                            " points, counted from 0, in column \"" + std::string(column) +
                            "\", not " + short_number(value, 10));
      return static_cast<std::uint32_t>(value);
    };
    std::vector<ListedSpring> springs;
    springs.reserve(table["a"].size());
    for (std::size_t n = 0; n < table["a"].size(); ++n) {
      const ListedSpring spring{end("a", n), end("b", n),
                                table["stiffness"].empty() ? 1 : table["stiffness"][n]};
      if (spring.a == spring.b)
        table.refuse(n, "two points, not " + std::to_string(spring.a) + " twice");
      if (spring.stiffness == 0) table.refuse(n, "a stiffness that is not 0");
      springs.push_back(spring);
    }
    if (springs.empty())
      throw std::invalid_argument("springs with at least one spring: it has no spring");
    check_once(table, springs);
    check_stiffness(positions, springs);
    return springs;
  }

  /// Reports an input error if two springs join the same points.
  static void check_once(const NumberTable& table, const std::vector<ListedSpring>& springs) {
    std::vector<std::size_t> order(springs.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto pair = [&](std::size_t n) { return std::minmax({springs[n].a, springs[n].b}); };
    std::sort(order.begin(), order.end(), [&](std::size_t m, std::size_t n) {
      return pair(m) != pair(n) ? pair(m) < pair(n) : m < n;
    });
    std::size_t first = 0, second = springs.size();
    for (std::size_t n = 1; n < order.size(); ++n)
      if (pair(order[n - 1]) == pair(order[n]) && order[n] < second) {
        first = order[n - 1];
        second = order[n];
      }
    if (second < springs.size())
      table.refuse(second, "a spring between points that no other joins; line " +
                               std::to_string(table.line(first)) + " joins " +
                               std::to_string(springs[first].a) + " and " +
                               std::to_string(springs[first].b) + " too");
  }

  /// Throws std::invalid_argument if the sum of stiffness times squared length over all springs is
  /// not positive: such a body has a negative stiffness against uniform expansion.
  void check_stiffness(const std::vector<Vec3>& positions,
                       const std::vector<ListedSpring>& springs) const {
    double sum = 0;
    for (const ListedSpring& spring : springs) {
      const Vec3 rest = positions[spring.b] - positions[spring.a];
      sum += spring.stiffness * dot(rest, rest);
    }
    if (!(sum > 0 && sum < infinity))
      throw std::invalid_argument("file " + *o_.springs +
                                  ": expected stiffnesses that are positive and finite in the sum, "
                                  "each times the squared length of its " +
                                  "spring: this is " + short_number(sum) + " m2");
  }

  std::vector<ListedSpring> nearest_springs(const std::vector<Vec3>& positions) const {
    Vec3 low{infinity, infinity, infinity}, high = -low;
    for (const Vec3 x : positions) {
      low = {std::min(low.x, x.x), std::min(low.y, x.y), std::min(low.z, x.z)};
      high = {std::max(high.x, x.x), std::max(high.y, x.y), std::max(high.z, x.z)};
    }
    const double count = static_cast<double>(positions.size());
    const Vec3 size = high - low;
    const double width = norm(size);
    if (!(width >= narrowest))
      throw std::invalid_argument("points that are " + short_number(narrowest) +
                                  " m apart or more, not " + short_number(width) + " m");
    const double box = std::max({size.x * size.y * size.z, 1e-9 * std::pow(width, 3)});
    // The search begins with pairs about as far apart as this, and ends only if it is not nearly 0.
    const double about = std::max(
        1e-15 * width, o_.spacing.value_or(std::cbrt(o_.particle_volume.value_or(box / count))));
    const std::vector<NearPair> pairs =
        pairs_with_coordination(positions, low, high, about, *o_.coordination);
    std::vector<ListedSpring> springs;
    springs.reserve(pairs.size());
    for (const NearPair& pair : pairs) springs.push_back({pair.a, pair.b, 1});
    return springs;
  }

  static double mean(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
  }
  static double mean_length(const std::vector<Vec3>& positions,
                            const std::vector<ListedSpring>& springs) {
    double sum = 0;
    for (const ListedSpring& spring : springs)
      sum += norm(positions[spring.b] - positions[spring.a]);
    return sum / static_cast<double>(springs.size());
  }

  Options o_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Points>(); }
