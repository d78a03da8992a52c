// A random lattice by random sequential addition: random points of the shape are tried one after
// the other, and a point is kept if it is not too near to an earlier one, until each spacing^3 has
// one. Springs join the nearest pairs, as many as give the mean coordination L_N,
//   springs = L_N particles / 2,
// and each particle to its six nearest at least (joined.hpp). The lattice is isotropic, but its
// deformation is not affine; the deviation is larger if particles have fewer neighbours. Its
// elastic constants are therefore computed from a sample: a periodic cube made by the same rules.
#include "joined.hpp"

#include <hyperlattice/lattice.hpp>

#include <random>
#include <stdexcept>

namespace {
using namespace hyperlattice;

constexpr double most_particles = 5e7;

/// Random numbers from a seed, the same on every machine.
class Dice {
 public:
  Dice(std::int64_t seed, std::uint64_t stream)
      : engine_(static_cast<std::uint64_t>(seed) + 0x9E3779B97F4A7C15u * stream) {}
  double number() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }  ///< in [0, 1)
  Vec3 point(Vec3 low, Vec3 high) {
    const double x = number(), y = number(), z = number();
    return {low.x + x * (high.x - low.x), low.y + y * (high.y - low.y),
            low.z + z * (high.z - low.z)};
  }

 private:
  std::mt19937_64 engine_;
};

/// Returns `count` random points of the box, m, where `inside` holds, at least `distance`, m,
/// apart. Throws std::invalid_argument if the box has no room for them.
template <class Inside>
std::vector<Vec3> throw_points(std::size_t count, Vec3 low, Vec3 high, double distance,
                               bool periodic, Dice dice, const Inside& inside) {
  constexpr std::size_t most_misses = 2000000;  // in a row; then no room for a point is left
  Neighbourhood thrown(low, high, distance, count, periodic);
  for (std::size_t misses = 0; thrown.points().size() < count;) {
    const Vec3 point = dice.point(low, high);
    bool free = inside(point);
    if (free) thrown.for_near(point, [&](std::uint32_t, Vec3) { free = false; });
    if (free) {
      thrown.add(point);
      misses = 0;
    } else if (++misses > most_misses) {
      throw std::invalid_argument(
          "min_distance that leaves room for one particle in every spacing^3: at most 0.88 fits");
    }
  }
  return thrown.points();
}

class Random {
 public:
  struct Options {
    double spacing = 0, coordination = 0, min_distance = 0;
    const Shape* shape = nullptr;
    std::int64_t seed = 0, sample = 0;
  };

  static Schema<Options> schema() {
    return Schema<Options>("lattices.random",
                           "Random points with a least distance, joined to the nearest")
        .equation(
            "particles = V / spacing^3; springs = coordination particles / 2: of each particle to "
            "its nearest six, then the shortest "
            "pairs; Delta = spacing")
        .source("Zhao 2017, section 2.4 and figure 3: mean coordinations 8.4 and 13.2")
        .restrictions(
            "boundary particles only; the Poisson ratio of few neighbours is above 1/4 without a "
            "membrane: 0.30 at 8.4, 0.25 at 13.2 in an infinite "
            "body; nodal volumes give larger ones. A particle at the "
            "surface has fewer springs, so those inside have more, and the "
            "largest Poisson ratio is less: at 8.4 about 0.27 "
            "in a body 10 particles across, 0.29 in one of 30; a coordination below 7 leaves no "
            "room for six springs each, and how stiff the lattice "
            "comes out is left to chance: plan and run warn of it")
        .add<&Options::spacing>("spacing", "m",
                                "mean spacing l: the body has one particle in every l^3")
        .positive()
        .add<&Options::shape>("shape", "", "the solid that is filled")
        .add<&Options::coordination>(
            "coordination", "",
            "mean number of springs of a particle, those at the surface counted too")
        .at_least(4)
        .at_most(40)
        .fallback("8.4")
        .add<&Options::min_distance>("min_distance", "",
                                     "least distance of two particles, over the spacing")
        .at_least(0.1)
        .at_most(0.88)
        .fallback("0.82")
        .add<&Options::seed>("seed", "", "another seed is another lattice of the same make")
        .at_least(0)
        .at_most(1LL << 53)
        .fallback("1")
        .add<&Options::sample>(
            "sample", "",
            "particles along an edge of the periodic sample that elastic constants are found from")
        .at_least(6)
        .at_most(60)
        .fallback("14");
  }

  explicit Random(const Options& options) : o_(options) {}

  void build(const LatticeSink& sink) const {
    const Shape& shape = *o_.shape;
    const double volume = volume_of_shape();
    const auto count = static_cast<std::size_t>(std::llround(volume / std::pow(o_.spacing, 3)));
    if (count < 2)
      throw std::invalid_argument(
          "shape that holds at least two particles: a larger one, or a smaller spacing");
    const double distance = o_.min_distance * o_.spacing;
    const std::vector<Vec3> points =
        throw_points(count, shape.low, shape.high, distance, false, Dice(o_.seed, 0),
                     [&](Vec3 point) { return shape.contains(point); });
    const auto wanted =
        static_cast<std::size_t>(std::llround(o_.coordination * static_cast<double>(count) / 2));
    if (wanted > count * (count - 1) / 2)
      throw std::invalid_argument("coordination that this number of particles can have");
    const Joined body = joined_by_number(
        count, pairs_to_choose_from(points, shape.low, shape.high, o_.spacing, wanted), wanted);

    std::vector<ListedSpring> springs;
    springs.reserve(body.springs.size());
    for (const NearPair& pair : body.springs) springs.push_back({pair.a, pair.b, 1});
    PointList list;
    list.spacing = list.membrane_distance = o_.spacing;
    list.site_volume = volume / static_cast<double>(count);
    list.positions = points;
    list.springs = springs;
    list.shape = &shape;
    sink.points(list);
    send_sample(sink, sink.for_analysis ? nullptr : &body);
  }

 private:
  /// Returns the volume of the shape, m3, counted on cubes of a quarter of the spacing.
  double volume_of_shape() const {
    const Shape& shape = *o_.shape;
    const Vec3 size = shape.high - shape.low;
    if (!std::isfinite(norm(size)))
      throw std::invalid_argument(
          "shape that is bounded, such as the intersection of a half-space with a box");
    if (size.x * size.y * size.z > most_particles * std::pow(o_.spacing, 3))
      throw std::invalid_argument(
          "spacing large enough for at most 5e7 particles, which a list holds");
    const auto steps = [&](double length) {
      return std::max<std::int64_t>(1, std::llround(4 * length / o_.spacing));
    };
    const std::int64_t nx = steps(size.x), ny = steps(size.y), nz = steps(size.z);
    std::uint64_t inside = 0;
    for (std::int64_t k = 0; k < nz; ++k)
      for (std::int64_t j = 0; j < ny; ++j)
        for (std::int64_t i = 0; i < nx; ++i) {
          const auto middle = [](std::int64_t n, std::int64_t of) {
            return (static_cast<double>(n) + 0.5) / static_cast<double>(of);
          };
          inside += shape.contains(shape.low + Vec3{size.x * middle(i, nx), size.y * middle(j, ny),
                                                    size.z * middle(k, nz)})
                        ? 1
                        : 0;
        }
    return size.x * size.y * size.z * static_cast<double>(inside) /
           static_cast<double>(nx * ny * nz);
  }

  /// Sends the periodic sample, joined by the rule `like` of the body, or by the coordination if
  /// `like` is null.
  void send_sample(const LatticeSink& sink, const Joined* like) const {
    const double edge = static_cast<double>(o_.sample) * o_.spacing;
    const Vec3 high{edge, edge, edge};
    const auto count = static_cast<std::size_t>(o_.sample * o_.sample * o_.sample);
    const std::vector<Vec3> points =
        throw_points(count, {}, high, o_.min_distance * o_.spacing, true, Dice(o_.seed, 1),
                     [](Vec3) { return true; });
    const double few_reach =
        std::min(1.7 * o_.spacing, 0.33 * edge);  // inside a body, six neighbours are nearer
    std::vector<NearPair> pairs = near_pairs(
        points, {}, high,
        like ? std::max(like->reach, few_reach) : 2 * o_.spacing * std::cbrt(o_.coordination / 8),
        true);
    if (like)
      pairs = joined_alike(count, std::move(pairs), *like);
    else
      pairs = joined_by_number(count, std::move(pairs),
                               static_cast<std::size_t>(
                                   std::llround(o_.coordination * static_cast<double>(count) / 2)))
                  .springs;
    std::vector<SampleSpring> springs;
    springs.reserve(pairs.size());
    for (const NearPair& pair : pairs) springs.push_back({pair.a, pair.b, pair.rest, 1});
    sink.sample({static_cast<std::uint32_t>(count), edge * edge * edge, springs});
  }

  Options o_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Random>(); }
