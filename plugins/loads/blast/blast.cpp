// A triangular pressure pulse on a surface, directed along the radii from a centre c:
//   F_i = p(t) A_i e_i,  e_i = (x_i - c) / |x_i - c|,  A_i = S sum over f of a_f (-n_f . e_i)
// over the open faces f of particle i, with the area a_f and the outward normal n_f. The pressure
// p(t) is 0 until `start`, rises to `peak` during `rise` and falls to 0 during `fall`. A surface
// of cubic cells is rougher than the true one; S makes the sum of |A_i| equal to the true area.
#include <hyperlattice/load.hpp>

#include <stdexcept>

namespace {
using namespace hyperlattice;

class Blast {
 public:
  struct Options {
    RegionId on;
    double peak = 0, rise = 0, fall = 0, start = 0;
    std::optional<Vec3> centre;
    std::optional<double> area;
  };

  static Schema<Options> schema() {
    return Schema<Options>("loads.blast",
                           "Triangular pressure pulse on a surface, along the radii from a centre")
        .equation("F = p(t) A e_r; p: 0 at start, peak at start + rise, 0 at start + rise + fall")
        .source("Zhao 2017, section 3.2, figure 7")
        .restrictions("for surfaces around or inside a centre: spheres, cavities, bore holes")
        .add<&Options::on>("on", "", "the loaded surface")
        .add<&Options::peak>("peak", "Pa", "largest pressure")
        .at_least(0)
        .add<&Options::rise>("rise", "s", "time from nothing to the peak")
        .positive()
        .add<&Options::fall>("fall", "s", "time from the peak to nothing")
        .positive()
        .add<&Options::start>("start", "s", "time at which the pulse begins")
        .at_least(0)
        .fallback("0")
        .add<&Options::centre>(
            "centre", "m",
            "where the radii begin; left out: the centre of the shape behind the region")
        .add<&Options::area>("area", "m2",
                             "true area of the loaded surface; left out: the shape's, if known, "
                             "else that of the cells")
        .positive();
  }

  explicit Blast(const Options& options) : o_(options) {}

  void declare(const LoadBody& body, const LoadSink& sink) const {
    const std::span<const OpenArea> surface = body.open_areas(o_.on);
    const Vec3 centre = o_.centre.value_or(body.centre(o_.on));
    const auto projected = [&](const OpenArea& open) {
      return -dot(open.area, direction(body.position(open.particle), centre));
    };
    double sum = 0;
    for (const OpenArea& open : surface) sum += std::abs(projected(open));
    if (sum == 0)
      throw std::invalid_argument(
          "the region has no open face: expected a surface, such as inner_surface");

    const double known = o_.area.value_or(body.true_area(o_.on));
    const double scale = known > 0 ? known / sum : 1;
    for (const OpenArea& open : surface)  // positive area: pressure away from the centre
      if (const double area = projected(open); area != 0)
        sink.force(open.particle,
                   scale * area * o_.peak * direction(body.position(open.particle), centre));
    for (const double corner : {o_.start, o_.start + o_.rise, o_.start + o_.rise + o_.fall})
      sink.corner(corner);
  }

  double factor(double time) const {
    const double since = time - o_.start;
    if (since <= 0 || since >= o_.rise + o_.fall) return 0;
    return since < o_.rise ? since / o_.rise : (o_.rise + o_.fall - since) / o_.fall;
  }

 private:
  static Vec3 direction(Vec3 position, Vec3 centre) {
    const Vec3 r = position - centre;
    const double length = norm(r);
    return length > 0 ? (1 / length) * r
                      : Vec3{};  // a particle at the centre has no radius, so no force
  }

  Options o_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Blast>(); }
