// A prescribed velocity of particles along the given axes a,
//   v_a(t) = value_a min(t / rise, 1).
// The other axes stay free.
#include <hyperlattice/load.hpp>

namespace {
using namespace hyperlattice;

class Velocity {
 public:
  struct Options {
    RegionId on;
    Vec3 value;
    AxisSet axes = AxisSet::xyz;
    double rise = 0;
  };

  static Schema<Options> schema() {
    return Schema<Options>("loads.velocity", "Prescribed velocity of a region")
        .equation("v(t) = value min(t / rise, 1) along the axes")
        .add<&Options::on>("on", "", "the particles driven")
        .add<&Options::value>("value", "m/s",
                              "velocity that is reached at the end of the rise and kept")
        .add<&Options::axes>(
            "axes", "", "along which the velocity is prescribed; value is ignored along the others")
        .choices(axis_set_names)
        .fallback("\"xyz\"")
        .add<&Options::rise>("rise", "s", "time from rest to the full velocity; 0: at once")
        .at_least(0)
        .fallback("0");
  }

  explicit Velocity(const Options& options) : o_(options) {}

  void declare(const LoadBody& body, const LoadSink& sink) const {
    for (const Particle particle : body.particles(o_.on))
      sink.velocity(particle, axes_of(o_.axes), o_.value);
    if (o_.rise > 0) sink.corner(o_.rise);
  }
  double factor(double time) const { return ramp(time, o_.rise); }

 private:
  Options o_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Velocity>(); }
