// Drag of a fluid, at rest or in motion, on the open faces of a surface. A face of present area A
// and present outward normal n moves with the velocity w relative to the fluid, w_n = (w . n) n
// normal to the face and w_t tangential:
//   F = - A [ (rho/2) C_n min(|w_n|, s) + m_n ] w_n  -  A [ (rho/2) C_t min(|w_t|, s) + m_t ] w_t
// with the linear coefficients m_n and m_t. The other terms are quadratic up to the speed s and
// linear beyond, which bounds the slope dF/dw.
#include <hyperlattice/watching.hpp>

#include <algorithm>
#include <cmath>

namespace {
using namespace hyperlattice;

class Drag {
 public:
  struct Options {
    RegionId on;
    Vec3 stream;
    double density = 0, across = 0, along = 0, linear_across = 0, linear_along = 0, top_speed = 0;
  };

  static Schema<Options> schema() {
    return Schema<Options>("loads.drag",
                           "Drag of a fluid on a surface, across its faces and along them")
        .equation(
            "F = -A (density/2 across min(|w_n|, top_speed) + linear_across) w_n - A (density/2 "
            "along min(|w_t|, top_speed) + linear_along) w_t")
        .source(
            "resistive force theory; Gray and Hancock 1955 for the linear part, Taylor 1952 for "
            "the quadratic one")
        .restrictions(
            "the fluid has no motion of its own beside the stream: no added mass, no wake. The "
            "open faces of a particle count as one, the sum of "
            "their "
            "areas: edges are a little rounder than they are")
        .add<&Options::on>("on", "", "the surface in the fluid")
        .fallback("\"outer_surface\"")
        .add<&Options::density>("density", "kg/m3", "of the fluid")
        .example("\"1000 kg/m3\"")
        .at_least(0)
        .fallback("0")
        .add<&Options::across>("across", "",
                               "coefficient of quadratic drag for motion across a face; both sides "
                               "of a plate together have twice of it")
        .at_least(0)
        .fallback("1")
        .add<&Options::along>("along", "", "the same for motion along a face")
        .at_least(0)
        .fallback("0")
        .add<&Options::linear_across>("linear_across", "Pa s/m",
                                      "linear drag of a unit of area for motion across a face")
        .at_least(0)
        .fallback("0")
        .add<&Options::linear_along>("linear_along", "Pa s/m", "the same for motion along a face")
        .at_least(0)
        .fallback("0")
        .add<&Options::top_speed>(
            "top_speed", "m/s",
            "up to which drag is quadratic; with it the coefficients enter the critical step")
        .positive()
        .fallback("10")
        .add<&Options::stream>("stream", "m/s", "velocity of the fluid")
        .fallback("[0, 0, 0]");
  }

  explicit Drag(const Options& options) : o_(options) {}

  void declare(const LoadBody& body, const LoadSink& sink) {
    const auto steepest = [&](double quadratic, double linear) {
      return o_.density * quadratic * o_.top_speed + linear;
    };  // slope of a force over velocity
    const double most =
        std::max(steepest(o_.across, o_.linear_across), steepest(o_.along, o_.linear_along));
    areas_.declare(body, sink, o_.on, [&](const OpenArea& open) {
      return LoadStiffnessBound{0, most * norm(open.area)};
    });
  }
  double factor(double) const { return 1; }

  Vec3 answer(const WatchedMotion& motion, std::size_t n) const {
    const Vec3 area = areas_.area(motion, n);
    const double size = norm(area);
    if (size == 0) return {};
    const Vec3 normal = (1 / size) * area, w = motion.velocity[n] - o_.stream;
    const Vec3 across = dot(w, normal) * normal, along = w - across;
    const auto drag = [&](double quadratic, double linear, double speed) {
      return size * (0.5 * o_.density * quadratic * std::min(speed, o_.top_speed) + linear);
    };
    return -drag(o_.across, o_.linear_across, norm(across)) * across -
           drag(o_.along, o_.linear_along, norm(along)) * along;
  }

 private:
  Options o_;
  MovingAreas areas_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Drag>(); }
