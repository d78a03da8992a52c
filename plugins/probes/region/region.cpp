// Mean, minimum and maximum of a quantity over a region, over time:
//   mean = (1/n) sum of q_i over the n particles of the region, all with the same weight.
// The component "radial" about the centre of a sphere gives the mean radial motion of a shell or
// surface; the column `radius` gives the mean distance of the particles from the centre at rest.
#include <hyperlattice/fields.hpp>

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
        "mean = (1/n) sum q_i; min = min q_i; max = max q_i; with the component radial also radius "
        "= (1/n) sum |x_i - centre|, at rest");
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
    for (std::size_t n = 0; n < count; ++n) {
      row[3 * n] = 0;
      row[3 * n + 1] = infinity;
      row[3 * n + 2] = -infinity;
    }
    double values[max_field_components] = {};
    for (const Particle particle : particles_) {
      quantity_.evaluate(snapshot, field, particle, values);
      for (std::size_t n = 0; n < count; ++n) {
        row[3 * n] += values[n];
        row[3 * n + 1] = std::min(row[3 * n + 1], values[n]);
        row[3 * n + 2] = std::max(row[3 * n + 2], values[n]);
      }
    }
    for (std::size_t n = 0; n < count; ++n) row[3 * n] /= static_cast<double>(particles_.size());
    if (is_radial_) row[3 * count] = radius_;
  }

 private:
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
