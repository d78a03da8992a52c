// A force on a region: `total` for all its particles together, or `each` for every particle,
//   F_i = f(t) total w_i / (sum of w)   or   F_i = f(t) each
// with w_i = 1. In a body of cells, w_i is the fraction of a whole particle, which gives a uniform
// stress on a plane face.
#include <hyperlattice/load.hpp>

namespace {
using namespace hyperlattice;

class Force {
 public:
  struct Options {
    RegionId on;
    std::optional<Vec3> total, each;
    double rise = 0;
  };

  static Schema<Options> schema() {
    return Schema<Options>("loads.force", "Force on a region, in total or on each particle")
        .equation(
            "F = f(t) total w / sum w or f(t) each, w the share of a whole particle; f rises in a "
            "straight line to 1 and stays")
        .add<&Options::on>("on", "", "the loaded particles")
        .add<&Options::total>(
            "total", "N",
            "shared evenly by the particles, in a body of cells by their shares of a whole one")
        .example("[\"10 N\", 0, 0]")
        .add<&Options::each>("each", "N", "on every particle")
        .add<&Options::rise>("rise", "s", "time from nothing to the full force; 0: at once")
        .at_least(0)
        .fallback("0")
        .check([](const Options& o, const FaultSink& faults) {
          if (o.total.has_value() == o.each.has_value())
            faults.fault(o.total ? "each" : "total", "exactly one of total and each");
        });
  }

  explicit Force(const Options& options) : o_(options) {}

  void declare(const LoadBody& body, const LoadSink& sink) const {
    const std::span<const Particle> particles = body.particles(o_.on);
    double sum = 0;
    for (const Particle particle : particles) sum += body.share(particle);
    for (const Particle particle : particles)
      sink.force(particle, o_.each ? *o_.each : (body.share(particle) / sum) * *o_.total);
    if (o_.rise > 0) sink.corner(o_.rise);
  }

  double factor(double time) const { return ramp(time, o_.rise); }

 private:
  Options o_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Force>(); }
