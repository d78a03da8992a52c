// The start velocity of a region, which moves freely afterwards:
//   v_i(0) = linear + angular x (x_i - centre)
#include <hyperlattice/load.hpp>

namespace {
using namespace hyperlattice;

class StartVelocity {
 public:
  struct Options {
    RegionId on;
    Vec3 linear, angular;
    std::optional<Vec3> centre;
  };

  static Schema<Options> schema() {
    return Schema<Options>("loads.start_velocity", "Velocity at time 0: translation and spin")
        .equation("v(0) = linear + angular x (x - centre)")
        .add<&Options::on>("on", "", "the particles set in motion")
        .fallback("\"all\"")
        .add<&Options::linear>("linear", "m/s", "the same for all particles")
        .example("[\"1 m/s\", 0, 0]")
        .fallback("[0, 0, 0]")
        .add<&Options::angular>("angular", "rad/s", "spin about the centre")
        .fallback("[0, 0, 0]")
        .add<&Options::centre>("centre", "m",
                               "of the spin; left out: the centre of the shape behind the region");
  }

  explicit StartVelocity(const Options& options) : o_(options) {}

  void declare(const LoadBody& body, const LoadSink& sink) const {
    const Vec3 centre = o_.centre.value_or(body.centre(o_.on));
    for (const Particle particle : body.particles(o_.on))
      sink.start_velocity(particle,
                          o_.linear + cross(o_.angular, body.position(particle) - centre));
  }
  double factor(double) const { return 0; }

 private:
  Options o_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<StartVelocity>(); }
