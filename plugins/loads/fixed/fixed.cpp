// A support: the particles do not move along the given axes a, u_a = 0. The other axes and the
// heights stay free.
#include <hyperlattice/load.hpp>

namespace {
using namespace hyperlattice;

class Fixed {
 public:
  struct Options {
    RegionId on;
    AxisSet axes = AxisSet::xyz;
  };

  static Schema<Options> schema() {
    return Schema<Options>("loads.fixed", "Particles that do not move along some axes")
        .equation("u = 0 along the axes")
        .add<&Options::on>("on", "", "the particles held")
        .add<&Options::axes>("axes", "", "along which they are held")
        .choices(axis_set_names)
        .fallback("\"xyz\"");
  }

  explicit Fixed(const Options& options) : o_(options) {}

  void declare(const LoadBody& body, const LoadSink& sink) const {
    for (const Particle particle : body.particles(o_.on))
      sink.displacement(particle, axes_of(o_.axes), {});
  }
  double factor(double) const { return 0; }

 private:
  Options o_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Fixed>(); }
