// A quantity along a straight line over time: at each of n evenly spaced points, that of the nearest particle. Points that share a particle
// give one column; points in the open, farther than a spacing from the body, give none. Each column's name says where its particle stands.
#include <hyperlattice/fields.hpp>

namespace hyperlattice {
namespace {

class LineProbe {
 public:
  struct Options : QuantityOptions {
    Vec3 start, end;
    std::int64_t points = 0;
  };

  static Schema<Options> schema() {
    Schema<Options> schema("probes.line", "A quantity along a straight line, over time");
    schema.add<&Options::start>("start", "m", "first point, in the body at rest")
        .add<&Options::end>("end", "m", "last point")
        .add<&Options::points>("points", "", "how many points, both ends included")
        .fallback("50")
        .at_least(2)
        .at_most(10000);
    add_quantity_options(schema);
    schema.restrictions("Points farther than a spacing from every particle are left out; a line with no other point is refused.");
    return schema.check([](const Options& options, const FaultSink& faults) {
      check_quantity_options(options, faults);
      if (options.start == options.end) faults.fault("end", "a point other than \"start\"");
    });
  }

  explicit LineProbe(const Options& options) : options_(options), quantity_(options) {}

  void begin(const OutputContext&, const Snapshot& first, const ColumnSink& columns) {
    require_field(first, quantity_.field());
    for (std::int64_t n = 0; n < options_.points; ++n) {
      const double along = static_cast<double>(n) / static_cast<double>(options_.points - 1);
      const Vec3 point = options_.start + along * (options_.end - options_.start);
      const Particle particle = nearest_particle(first, point);
      const bool in_the_open = norm(position_of(first, particle) - point) > first.spacing;
      if (!in_the_open && std::find(particles_.begin(), particles_.end(), particle) == particles_.end()) particles_.push_back(particle);
    }
    if (particles_.empty())
      throw std::runtime_error("no particle is near the line from " + place_text(options_.start) + " to " + place_text(options_.end) + " (metres)");
    for (const Particle particle : particles_)
      for (const std::string& name : quantity_.names()) columns.column(name + "@" + place_text(position_of(first, particle)));
  }

  void sample(const Snapshot& snapshot, double* row) const {
    const Field field = require_field(snapshot, quantity_.field());
    for (const Particle particle : particles_) {
      quantity_.evaluate(snapshot, field, particle, row);
      row += quantity_.names().size();
    }
  }

 private:
  Options options_;
  Quantity quantity_;
  std::vector<Particle> particles_;
};

}  // namespace
}  // namespace hyperlattice

HYPERLATTICE_PLUGIN("1.0") { plugin.add<hyperlattice::LineProbe>(); }
