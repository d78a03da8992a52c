// Mean, minimum and maximum of a quantity over a region, over time:
//   mean = (1/n) sum of q_i over the n particles of the region, all with the same weight.
// Particles without a value, whose quantity is not a number, do not count.
// The component "radial" about the centre of a sphere gives the mean radial motion of a shell or
// surface; the column `radius` gives the mean distance of the particles from the centre at rest.
#include <hyperlattice/fields.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hyperlattice {
namespace {

class RegionProbe {
 public:
  struct Options : QuantityOptions {
    RegionId region;
  };

  static Schema<Options> schema() {
    Schema<Options> schema("probes.region",
                           "Mean and extremes of a quantity over a region, over time");
    schema.add<&Options::region>("region", "", "the particles").fallback("\"all\"");
    add_quantity_options(schema);
    schema.equation(
        "mean = (1/n) sum q_i; min = min q_i; max = max q_i, over the n particles that have a "
        "value, "
        "nan if none has; with the component radial also radius = (1/n) sum |x_i - centre|, at "
        "rest, over all particles");
    return schema.check(check_quantity_options<Options>);
  }

  explicit RegionProbe(const Options& options)
      : region_(options.region),
        quantity_(options),
        is_radial_(options.component == Projection::radial),
        centre_(options.centre) {}

  void begin(const OutputContext& context, const Snapshot& first, const ColumnSink& columns) {
    require_field(context, first, quantity_.field());
    const auto particles = context.particles(region_);
    particles_.assign(particles.begin(), particles.end());
    if (particles_.empty()) throw std::runtime_error("no particle lies in the region");
    for (const std::string& name : quantity_.names())
      for (const char* statistic : {"_mean", "_min", "_max"}) columns.column(name + statistic);
    if (!is_radial_) return;
    columns.column("radius");
    for (const Particle particle : particles_)
      radius_ +=
          norm(position_of(first, particle) - centre_) / static_cast<double>(particles_.size());
  }

  void sample(const Snapshot& snapshot, double* row) const {
    const Field field = require_field(snapshot, quantity_.field());
    const std::size_t count = quantity_.names().size();
    std::array<Range, max_field_components> ranges;
    double values[max_field_components] = {};
    for (const Particle particle : particles_) {
      quantity_.evaluate(snapshot, field, particle, values);
      for (std::size_t n = 0; n < count; ++n) ranges[n].add(values[n]);
    }
    for (std::size_t n = 0; n < count; ++n) ranges[n].write(row + 3 * n);
    if (is_radial_) row[3 * count] = radius_;
  }

 private:
  /// Mean and extremes of the values that are numbers.
  struct Range {
    double sum = 0, least = infinity, most = -infinity;
    std::size_t count = 0;
    void add(double value) {
      if (std::isnan(value)) return;
      sum += value;
      least = std::min(least, value);
      most = std::max(most, value);
      ++count;
    }
    /// Writes mean, least and most; nan if there is no value.
    void write(double* to) const {
      constexpr double none = std::numeric_limits<double>::quiet_NaN();
      to[0] = count == 0 ? none : sum / static_cast<double>(count);
      to[1] = count == 0 ? none : least;
      to[2] = count == 0 ? none : most;
    }
  };

  RegionId region_;
  Quantity quantity_;
  bool is_radial_;
  Vec3 centre_;
  double radius_ = 0;
  std::vector<Particle> particles_;
};

}  // namespace
}  // namespace hyperlattice

HYPERLATTICE_PLUGIN("1.0") { plugin.add<hyperlattice::RegionProbe>(); }
