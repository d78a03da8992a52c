// A pressure on the open faces of a region's particles:
//   F_i = - p(t) l^2 * (sum of the outward normals of its open faces)
#include <hyperlattice/load.hpp>

#include <stdexcept>

namespace {
using namespace hyperlattice;

class Pressure {
 public:
  struct Options {
    RegionId on;
    double pressure = 0, rise = 0;
  };

  static Schema<Options> schema() {
    return Schema<Options>("loads.pressure", "Pressure on the open faces of a surface")
        .equation("F = -p(t) l^2 n for each open face; p rises in a straight line and stays")
        .restrictions("a surface that is not parallel to the axes is loaded as the staircase that its particles make of it")
        .add<&Options::on>("on", "", "the loaded surface; x_min and its like load only the faces of that side")
        .add<&Options::pressure>("pressure", "Pa", "positive pushes on the body, negative pulls")
        .add<&Options::rise>("rise", "s", "time from nothing to the full pressure; 0: at once")
        .at_least(0)
        .fallback("0");
  }

  explicit Pressure(const Options& options) : o_(options) {}

  void declare(const LoadBody& body, const LoadSink& sink) const {
    const double force = o_.pressure * body.spacing * body.spacing;
    const std::span<const Particle> particles = body.particles(o_.on);
    bool any = particles.empty();
    for (const Particle particle : particles) {
      const ExposedFaces open = body.exposed_faces(particle, o_.on);
      Vec3 normal;
      for (unsigned f = 0; f < 6; ++f)
        if (open >> f & 1U) normal = normal + face_normals[f];
      if (open != 0) any = true;
      if (normal != Vec3{}) sink.force(particle, -force * normal);
    }
    if (!any) throw std::invalid_argument("the region has no open face: expected a surface, such as x_max");
    if (o_.rise > 0) sink.corner(o_.rise);
  }

  double factor(double time) const { return ramp(time, o_.rise); }

 private:
  Options o_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Pressure>(); }
