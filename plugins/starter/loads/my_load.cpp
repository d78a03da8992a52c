// A push that begins and ends smoothly: a force on a region, shared evenly by its particles, that
// follows
//   f(t) = sin^2(pi t / duration)   up to t = duration, then nothing.
// Its impulse is half of the force times the duration.
#include <hyperlattice/load.hpp>

#include <cmath>
#include <numbers>

namespace {
using namespace hyperlattice;

class MyLoad {
 public:
  struct Options {
    RegionId on;
    Vec3 total;
    double duration = 0;
  };

  static Schema<Options> schema() {
    return Schema<Options>("loads.my_load", "A push on a region that begins and ends smoothly")
        .equation(
            "F = total f(t) / n on each of n particles; f(t) = sin^2(pi t / duration) for 0 <= t "
            "<= duration, else 0")
        .add<&Options::on>("on", "", "the particles pushed")
        .add<&Options::total>("total", "N", "largest force, shared evenly")
        .example("[\"10 N\", 0, 0]")
        .add<&Options::duration>("duration", "s", "from the begin to the end of the push")
        .positive()
        .example("\"10 us\"");
  }

  explicit MyLoad(const Options& options) : o_(options) {}

  // Called once, before the run: what acts on which particle, and where factor(time) has a kink or
  // jump.
  void declare(const LoadBody& body, const LoadSink& sink) const {
    const std::span<const Particle> particles = body.particles(o_.on);
    for (const Particle particle : particles)
      sink.force(particle, o_.total / static_cast<double>(particles.size()));
    sink.corner(o_.duration);
  }

  // What all of it is multiplied by.
  double factor(double time) const {
    const double root = std::sin(std::numbers::pi * time / o_.duration);
    return time < o_.duration ? root * root : 0;
  }

 private:
  Options o_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<MyLoad>(); }
