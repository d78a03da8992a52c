// A lattice from a file: particles where a table of points says, joined by a table of springs, or to the nearest as many as a mean coordination asks
// for. The door for any structure: a packing, a mesh's nodes, a scanned grain, a design of one's own.
//   points:  x, y, z and, if it is there, volume
//   springs: a, b and, if it is there, stiffness, over k; a and b count the points from 0
#include <hyperlattice/files.hpp>
#include <hyperlattice/lattice.hpp>
#include <hyperlattice/neighbourhood.hpp>
#include <hyperlattice/tables.hpp>

#include <stdexcept>

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
        .equation("springs: those of the file, or the coordination particles / 2 shortest pairs; Delta = spacing")
        .source("any structure: Zhao 2017, section 2.4, treats lattices whose points are random")
        .restrictions(
            "boundary particles only. Elastic constants are estimated as if all springs were strained alike, which makes E too large, by a tenth to "
            "a "
            "half for random points: give lambda in place of poisson, and compare with a test on the body")
        .add<&Options::points>("points", "", "CSV file with the columns x, y, z, times scale in metres, and perhaps volume, times scale^3 in m3")
        .file()
        .add<&Options::springs>("springs", "", "CSV file with the columns a, b, counting points from 0, and perhaps stiffness, over k")
        .file()
        .add<&Options::coordination>("coordination", "", "in place of springs: mean number of springs of a particle, to the nearest")
        .at_least(1)
        .at_most(100)
        .add<&Options::scale>("scale", "m", "length of the files' unit")
        .positive()
        .fallback("1")
        .add<&Options::particle_volume>("particle_volume", "m3", "of every particle, if the file has no volumes; left out: the cube of the spacing")
        .positive()
        .add<&Options::spacing>("spacing", "m", "lattice constant, which is Delta too; left out: the mean length of the springs")
        .positive()
        .add<&Options::shape>("shape", "",
                              "the solid that the points stand for, for regions on its surface and for its volume; left out: near to points")
        .check([](const Options& o, const FaultSink& faults) {
          if (o.springs.has_value() == o.coordination.has_value()) faults.fault("springs", "one of springs and coordination");
        });
  }

  explicit Points(const Options& options) : o_(options) {}

  void build(const LatticeSink& sink) const {
    static constexpr std::string_view coordinates[] = {"x", "y", "z"}, volume[] = {"volume"};
    const NumberTable table(o_.points, coordinates, volume);
    std::vector<Vec3> positions;
    positions.reserve(table["x"].size());
    Vec3 low{infinity, infinity, infinity}, high = -1.0 * low;
    for (std::size_t n = 0; n < table["x"].size(); ++n) {
      const Vec3 x = o_.scale * Vec3{table["x"][n], table["y"][n], table["z"][n]};
      positions.push_back(x);
      low = {std::min(low.x, x.x), std::min(low.y, x.y), std::min(low.z, x.z)};
      high = {std::max(high.x, x.x), std::max(high.y, x.y), std::max(high.z, x.z)};
    }
    if (positions.size() < 2) throw std::invalid_argument("points has fewer than two particles");
    std::vector<double> volumes = table["volume"];
    for (double& v : volumes) v *= o_.scale * o_.scale * o_.scale;
    const std::vector<ListedSpring> springs = o_.springs ? springs_of_file(positions.size()) : nearest_springs(positions, low, high);

    PointList list;
    list.positions = positions;
    list.volumes = volumes;
    list.springs = springs;
    const double length = mean_length(positions, springs);
    list.spacing = list.membrane_distance = o_.spacing.value_or(length);
    // where all springs join particles to themselves, the core says so
    if (length > 0 && !(list.spacing >= length / most_apart && list.spacing <= length * most_apart))
      throw std::invalid_argument("spacing is " + short_number(list.spacing) + " m, while the springs are " + short_number(length) +
                                  " m long in the mean: expected a spacing between " + short_number(length / most_apart) + " and " +
                                  short_number(length * most_apart) + " m");
    list.site_volume = o_.particle_volume.value_or(volumes.empty() ? std::pow(list.spacing, 3) : mean(volumes));
    list.shape = o_.shape.value_or(nullptr);
    sink.points(list);
  }

 private:
  static constexpr double most_apart = 20;  // the surface is made of cubes of half a spacing

  std::vector<ListedSpring> springs_of_file(std::size_t particles) const {
    static constexpr std::string_view ends[] = {"a", "b"}, more[] = {"stiffness"};
    const NumberTable table(*o_.springs, ends, more);
    const auto number = [&](double value, std::size_t n) {
      if (value != std::floor(value) || value < 0 || value >= static_cast<double>(particles))
        throw std::invalid_argument("springs: spring " + std::to_string(n) + " has an end that is none of the " + std::to_string(particles) +
                                    " particles, counted from 0");
      return static_cast<std::uint32_t>(value);
    };
    std::vector<ListedSpring> springs;
    springs.reserve(table["a"].size());
    for (std::size_t n = 0; n < table["a"].size(); ++n)
      springs.push_back({number(table["a"][n], n), number(table["b"][n], n), table["stiffness"].empty() ? 1 : table["stiffness"][n]});
    if (springs.empty()) throw std::invalid_argument("springs has no spring");
    return springs;
  }

  std::vector<ListedSpring> nearest_springs(const std::vector<Vec3>& positions, Vec3 low, Vec3 high) const {
    const double count = static_cast<double>(positions.size());
    const Vec3 size = high - low;
    const double box = std::max({size.x * size.y * size.z, 1e-9 * std::pow(norm(size), 3)});
    const double about = o_.spacing.value_or(std::cbrt(o_.particle_volume.value_or(box / count)));
    const std::vector<NearPair> pairs = pairs_with_coordination(positions, low, high, about, *o_.coordination);
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
  static double mean_length(const std::vector<Vec3>& positions, const std::vector<ListedSpring>& springs) {
    double sum = 0;
    for (const ListedSpring& spring : springs) sum += norm(positions[spring.b] - positions[spring.a]);
    return sum / static_cast<double>(springs.size());
  }

  Options o_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Points>(); }
