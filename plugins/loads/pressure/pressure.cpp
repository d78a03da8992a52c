// A pressure on the open faces of a region:
//   F_i = - p(t) A_i,  A_i the sum of the outward normals of the particle's faces, each by its area:
// l^2, or a quarter of that for each corner of a face in a body of cells.
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
        .equation("F = -p(t) A n for each open face; p rises in a straight line and stays")
        .restrictions("a surface that is not parallel to the axes is loaded as the staircase that its particles make of it")
        .add<&Options::on>("on", "", "the loaded surface; x_min and its like load only the faces of that side")
        .add<&Options::pressure>("pressure", "Pa", "positive pushes on the body, negative pulls")
        .add<&Options::rise>("rise", "s", "time from nothing to the full pressure; 0: at once")
        .at_least(0)
        .fallback("0");
  }

  explicit Pressure(const Options& options) : o_(options) {}

  void declare(const LoadBody& body, const LoadSink& sink) const {
    const std::span<const OpenArea> surface = body.open_areas(o_.on);
    for (const OpenArea& open : surface)
      if (open.area != Vec3{}) sink.force(open.particle, -o_.pressure * open.area);
    if (surface.empty()) throw std::invalid_argument("the region has no open face: expected a surface, such as x_max");
    if (o_.rise > 0) sink.corner(o_.rise);
  }

  double factor(double time) const { return ramp(time, o_.rise); }

 private:
  Options o_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Pressure>(); }
