// A pressure on the open faces of a region:
//   F_i = - p(t) A_i,  A_i = sum of area times outward normal over the open faces of particle i
// A face has the area l^2; in a body of cells, each of its four corner particles has l^2 / 4; in a
// body of partial cells, times the difference of the shares of the two cells at the face. With
// `facing`, only the faces with one direction of the normal count.
#include <hyperlattice/load.hpp>

#include <algorithm>
#include <stdexcept>

namespace {
using namespace hyperlattice;

enum class Facing : std::uint32_t { any, x_min, x_max, y_min, y_max, z_min, z_max };
constexpr std::string_view facing_names[] = {"any",   "x_min", "x_max", "y_min",
                                             "y_max", "z_min", "z_max"};

class Pressure {
 public:
  struct Options {
    RegionId on;
    double pressure = 0, rise = 0;
    Facing facing = Facing::any;
  };

  static Schema<Options> schema() {
    return Schema<Options>("loads.pressure", "Pressure on the open faces of a surface")
        .equation("F = -p(t) A n for each open face; p rises in a straight line and stays")
        .restrictions(
            "a surface that is not parallel to the axes is loaded as the staircase that its "
            "particles make of it, but for partial cells, which have the areas of the shape. With "
            "partial cells a region has to reach a spacing beyond the surface on both sides")
        .add<&Options::on>(
            "on", "", "the loaded surface; x_min and its like load only the faces of that side")
        .add<&Options::pressure>("pressure", "Pa", "positive pushes on the body, negative pulls")
        .add<&Options::facing>(
            "facing", "",
            "which faces of the region are loaded: those that look towards that side of the body")
        .choices(facing_names)
        .fallback("\"any\"")
        .add<&Options::rise>("rise", "s", "time from nothing to the full pressure; 0: at once")
        .at_least(0)
        .fallback("0");
  }

  explicit Pressure(const Options& options) : o_(options) {}

  void declare(const LoadBody& body, const LoadSink& sink) const {
    const std::span<const OpenArea> surface = body.open_areas(o_.on);
    bool any = false;
    for (const OpenArea& open : surface)
      if (const Vec3 area = loaded(open.area); area != Vec3{}) {
        sink.force(open.particle, -o_.pressure * area);
        any = true;
      }
    if (surface.empty())
      throw std::invalid_argument("the region has no open face: expected a surface, such as x_max");
    if (!any && o_.facing != Facing::any)
      throw std::invalid_argument("facing names a side to which no open face of the region looks");
    if (o_.rise > 0) sink.corner(o_.rise);
  }

  double factor(double time) const { return ramp(time, o_.rise); }

 private:
  /// Returns the part of a particle's open area, m2, whose normal has the direction `facing`.
  Vec3 loaded(Vec3 area) const {
    if (o_.facing == Facing::any) return area;
    const Vec3 normal = face_normals[static_cast<std::size_t>(o_.facing) - 1];
    return std::max(0.0, dot(area, normal)) * normal;
  }

  Options o_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Pressure>(); }
