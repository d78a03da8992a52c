// A quantity over time at n evenly spaced points of a straight line: interpolated between the
// particles around each point, or that of the nearest particle.
#include "interpolation.hpp"

#include <hyperlattice/fields.hpp>

namespace hyperlattice {
namespace {

enum class Between : std::uint32_t { interpolated, nearest };
constexpr std::string_view between_names[] = {"interpolated", "nearest"};

class LineProbe {
 public:
  struct Options : QuantityOptions {
    Vec3 start, end;
    std::int64_t points = 0;
    Between between = Between::interpolated;
  };

  static Schema<Options> schema() {
    Schema<Options> schema("probes.line", "A quantity along a straight line, over time");
    schema.add<&Options::start>("start", "m", "first point, in the body at rest")
        .add<&Options::end>("end", "m", "last point")
        .add<&Options::points>("points", "", "how many points, both ends included")
        .fallback("50")
        .at_least(2)
        .at_most(10000)
        .add<&Options::between>("between", "",
                                "between particles: interpolated from those around, or that of the "
                                "nearest particle, each of which then gives one column")
        .choices(between_names)
        .fallback("\"interpolated\"");
    add_quantity_options(schema);
    schema.equation(
        "f(x) = a + b . x, fitted to the particles within R by least squares with weights (1 - d^2 "
        "/ R^2)^2 / (d^2 / l^2 + 1e-6), d the distance, "
        "l the spacing, R = 1.5 l, or 1.25 l more than the distance of the nearest particle if "
        "that is more");
    schema.restrictions(
        "Points farther than a spacing from every particle are left out; a line with no other "
        "point is refused. Affine fields are interpolated "
        "exactly, "
        "to the surface and beyond it. Particles on both sides of a gap narrower than R are fitted "
        "together. Of numbers that are labels (material, "
        "source) ask for the nearest.");
    return schema.check([](const Options& options, const FaultSink& faults) {
      check_quantity_options(options, faults);
      if (options.start == options.end) faults.fault("end", "a point other than \"start\"");
    });
  }

  explicit LineProbe(const Options& options) : options_(options), quantity_(options) {}

  void begin(const OutputContext& context, const Snapshot& first, const ColumnSink& columns) {
    require_field(context, first, quantity_.field());
    const std::vector<Particle> near = near_line(first);
    for (std::int64_t n = 0; n < options_.points; ++n) {
      const double along = static_cast<double>(n) / static_cast<double>(options_.points - 1);
      add_point(options_.start + along * (options_.end - options_.start), first, near);
    }
    if (points_.empty())
      throw std::runtime_error("no particle is near the line from " + place_text(options_.start) +
                               " to " + place_text(options_.end) + " (metres)");
    for (const Point& point : points_)
      for (const std::string& name : quantity_.names())
        columns.column(name + "@" + place_text(point.place));
  }

  void sample(const Snapshot& snapshot, double* row) const {
    const Field field = require_field(snapshot, quantity_.field());
    for (const Point& point : points_) {
      double value[max_field_components] = {};
      for (const line::Share& share : point.shares)
        for (std::size_t c = 0; c < field.components; ++c)
          value[c] += share.weight * field.values[share.particle * field.components + c];
      quantity_.project(value, point.place, row);
      row += quantity_.names().size();
    }
  }

 private:
  struct Point {
    Vec3 place;
    std::vector<line::Share> shares;
  };

  /// Returns the particles that are near enough to have a weight at a point of the line.
  std::vector<Particle> near_line(const Snapshot& first) const {
    const Vec3 way = options_.end - options_.start;
    const double reach = 2.25 * first.spacing;
    std::vector<Particle> near;
    for (Particle particle = 0; particle < first.particles; ++particle) {
      const Vec3 from = position_of(first, particle) - options_.start;
      const Vec3 apart = from - std::clamp(dot(from, way) / dot(way, way), 0.0, 1.0) * way;
      if (norm(apart) <= reach) near.push_back(particle);
    }
    return near;
  }

  void add_point(Vec3 place, const Snapshot& first, const std::vector<Particle>& near) {
    const auto apart = [&](Particle particle) {
      return norm(position_of(first, particle) - place);
    };
    const auto nearest = std::min_element(
        near.begin(), near.end(), [&](Particle a, Particle b) { return apart(a) < apart(b); });
    if (nearest == near.end() || apart(*nearest) > first.spacing) return;
    if (options_.between == Between::interpolated) {
      const double radius = std::max(1.5 * first.spacing, apart(*nearest) + 1.25 * first.spacing);
      points_.push_back({place, line::shares_at(place, first.spacing, radius, first, near)});
    } else if (std::none_of(points_.begin(), points_.end(), [&](const Point& point) {
                 return point.shares.front().particle == *nearest;
               })) {
      points_.push_back({position_of(first, *nearest), {{*nearest, 1}}});
    }
  }

  Options options_;
  Quantity quantity_;
  std::vector<Point> points_;
};

}  // namespace
}  // namespace hyperlattice

HYPERLATTICE_PLUGIN("1.0") { plugin.add<hyperlattice::LineProbe>(); }
