// A prescribed displacement of particles along the given axes a,
//   u_a(t) = value_a min(t / rise, 1).
// The other axes stay free.
#include <hyperlattice/load.hpp>

namespace {
using namespace hyperlattice;

class Displacement {
 public:
  struct Options {
    RegionId on;
    Vec3 value;
    AxisSet axes = AxisSet::xyz;
    double rise = 0;
  };

  static Schema<Options> schema() {
    return Schema<Options>("loads.displacement", "Prescribed displacement of a region")
        .equation("u(t) = value min(t / rise, 1) along the axes")
        .add<&Options::on>("on", "", "the particles moved")
        .add<&Options::value>("value", "m",
                              "displacement that is reached at the end of the rise and kept")
        .example("[\"1 um\", 0, 0]")
        .add<&Options::axes>(
            "axes", "",
            "along which the displacement is prescribed; value is ignored along the others")
        .choices(axis_set_names)
        .fallback("\"xyz\"")
        .add<&Options::rise>("rise", "s", "time from rest to the full value, at constant speed")
        .example("\"10 us\"")
        .positive();
  }

  explicit Displacement(const Options& options) : o_(options) {}

  void declare(const LoadBody& body, const LoadSink& sink) const {
    for (const Particle particle : body.particles(o_.on))
      sink.displacement(particle, axes_of(o_.axes), o_.value);
    sink.corner(o_.rise);
  }
  double factor(double time) const { return ramp(time, o_.rise); }

 private:
  Options o_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Displacement>(); }
