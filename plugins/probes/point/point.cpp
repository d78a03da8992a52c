// A quantity over time of the particle that is nearest to a given position. The column's name gives
// the true position of this particle.
#include <hyperlattice/fields.hpp>

namespace hyperlattice {
namespace {

class PointProbe {
 public:
  struct Options : QuantityOptions {
    Vec3 position;
  };

  static Schema<Options> schema() {
    Schema<Options> schema("probes.point",
                           "A quantity of the particle nearest to a place, over time");
    schema.add<&Options::position>("position", "m", "the place, in the body at rest");
    add_quantity_options(schema);
    schema.restrictions("A place farther than two spacings from every particle is refused.");
    return schema.check(check_quantity_options<Options>);
  }

  explicit PointProbe(const Options& options) : place_(options.position), quantity_(options) {}

  void begin(const OutputContext& context, const Snapshot& first, const ColumnSink& columns) {
    require_field(context, first, quantity_.field());
    particle_ = nearest_particle(first, place_);
    const Vec3 stands = position_of(first, particle_);
    if (norm(stands - place_) > 2 * first.spacing)
      throw std::runtime_error("no particle is near " + place_text(place_) +
                               "; the nearest stands at " + place_text(stands) + " (metres)");
    for (const std::string& name : quantity_.names())
      columns.column(name + "@" + place_text(stands));
  }

  void sample(const Snapshot& snapshot, double* row) const {
    quantity_.evaluate(snapshot, require_field(snapshot, quantity_.field()), particle_, row);
  }

 private:
  Vec3 place_;
  Quantity quantity_;
  Particle particle_ = 0;
};

}  // namespace
}  // namespace hyperlattice

HYPERLATTICE_PLUGIN("1.0") { plugin.add<hyperlattice::PointProbe>(); }
