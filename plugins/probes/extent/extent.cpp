// Where a quantity exceeds a bound, over time: how many particles of a region, and the least, mean
// and largest place of these along x, y and z. Of damage this is how far a crack has come, where it
// branches and where a branch is.
#include <hyperlattice/fields.hpp>

#include <algorithm>

namespace hyperlattice {
namespace {

class ExtentProbe {
 public:
  struct Options : QuantityOptions {
    RegionId region;
    double above = 0;
    Vec3 from;
    std::optional<Vec3> along;
  };

  static Schema<Options> schema() {
    Schema<Options> schema("probes.extent", "Where a quantity exceeds a bound, over time");
    schema.add<&Options::region>("region", "", "the particles").fallback("\"all\"");
    add_quantity_options(schema);
    schema.add<&Options::above>("above", "", "the bound, in the SI unit of the field")
        .example("0.9")
        .add<&Options::from>("from", "m", "where places and distances are measured from")
        .fallback("[0, 0, 0]")
        .add<&Options::along>("along", "",
                              "a direction, of any length, along which places are measured too, "
                              "for a body at an angle to the axes")
        .nonzero()
        .equation(
            "over the particles of the region with q_i > above: count; mean, min and max of the "
            "components of X_i - from, of distance = |X_i - from| and, with along, of "
            "along . (X_i - from) / |along|, X_i the place at rest; 0 if there is no such "
            "particle")
        .restrictions("the quantity is one number: a vector or a tensor needs a component");
    return schema.check([](const Options& o, const FaultSink& faults) {
      check_quantity_options(o, faults);
      const FieldInfo* field = find_field(o.field);
      if (!o.component && field != nullptr && field->kind != FieldKind::number)
        faults.fault("component",
                     "a component of \"" + o.field + "\": " + joined(projections_of(field->kind)));
    });
  }

  explicit ExtentProbe(const Options& options)
      : region_(options.region),
        quantity_(options),
        above_(options.above),
        from_(options.from),
        along_(options.along ? direction_of(*options.along) : Vec3{}),
        statistics_(options.along ? 5 : 4) {}

  void begin(const OutputContext& context, const Snapshot& first, const ColumnSink& columns) {
    require_field(context, first, quantity_.field());
    const auto particles = context.particles(region_);
    particles_.assign(particles.begin(), particles.end());
    if (particles_.empty()) throw std::runtime_error("no particle lies in the region");
    columns.column("count");
    constexpr const char* places[] = {"x", "y", "z", "distance", "along"};
    for (std::size_t n = 0; n < statistics_; ++n)
      for (const char* statistic : {"_mean", "_min", "_max"})
        columns.column(std::string(places[n]) + statistic);
  }

  void sample(const Snapshot& snapshot, double* row) const {
    const Field field = require_field(snapshot, quantity_.field());
    double sum[5] = {}, least[5], most[5], value = 0;
    std::fill_n(least, 5, infinity);
    std::fill_n(most, 5, -infinity);
    std::size_t count = 0;
    for (const Particle particle : particles_) {
      quantity_.evaluate(snapshot, field, particle, &value);
      if (!(value > above_)) continue;
      ++count;
      const Vec3 at = position_of(snapshot, particle) - from_;
      const double places[] = {at.x, at.y, at.z, norm(at), dot(at, along_)};
      for (std::size_t n = 0; n < statistics_; ++n) {
        sum[n] += places[n];
        least[n] = std::min(least[n], places[n]);
        most[n] = std::max(most[n], places[n]);
      }
    }
    *row++ = static_cast<double>(count);
    for (std::size_t n = 0; n < statistics_; ++n) {
      *row++ = count == 0 ? 0 : sum[n] / static_cast<double>(count);
      *row++ = count == 0 ? 0 : least[n];
      *row++ = count == 0 ? 0 : most[n];
    }
  }

 private:
  RegionId region_;
  Quantity quantity_;
  double above_;
  Vec3 from_, along_;
  std::size_t statistics_;  ///< numbers of each particle of which there are mean and extremes
  std::vector<Particle> particles_;
};

}  // namespace
}  // namespace hyperlattice

HYPERLATTICE_PLUGIN("1.0") { plugin.add<hyperlattice::ExtentProbe>(); }
