// Internal forces that move a robot: a muscle or an engine inside the body, or the pressure in a
// chamber, times a load factor f(t).
//   force:    each base spring of the region pushes its ends apart with the force f(t) F w; in a
//             body of cells, w is the fraction of a whole spring
//   strain:   the rest length of each base spring becomes L0 (1 + f(t) e); a linear spring of
//             stiffness k then has the additional force k L0 f(t) e, exactly
//   pressure: each open face of the region has the force -f(t) p A, with its present area A
// The forces of a spring on its two ends are opposite, so their sum on the body is zero.
#include <hyperlattice/time_function.hpp>
#include <hyperlattice/watching.hpp>

namespace {
using namespace hyperlattice;

class Actuation {
 public:
  struct Options : TimeOptions {
    RegionId on;
    std::optional<double> force, strain, pressure;
  };

  static Schema<Options> schema() {
    Schema<Options> schema("loads.actuation",
                           "Forces along the springs of a region, a change of their rest length, "
                           "or a pressure that follows the surface");
    schema.equation(actuation_equation)
        .source(
            "Zhao 2017, section 3.3, figure 9: a pulse on the spring-linked particles of a robot's "
            "engine")
        .restrictions(
            "force and strain act in the three dimensions, along base springs with both ends in "
            "the region, which must not break; they stiffen "
            "or soften a spring against turning by their force over its length, as its own "
            "elongation does, which the solver's safety is for. "
            "Springs of the membrane keep their length: a free body whose base springs all get "
            "strain e grows by e K0 / K only, K0 = 5 k / (3 l) "
            "the bulk modulus of a cubic lattice's base springs alone, K that of the lattice, E / "
            "(3 (1 - 2 nu)) if it is isotropic; by e without "
            "a membrane, by 0.76 e with I-m at nu = 0.1, by 0.31 e at nu = -0.1")
        .add<&Options::on>("on", "",
                           "the particles whose springs act, or the surface under pressure")
        .add<&Options::force>("force", "N",
                              "of each base spring at f = 1; positive pushes its ends apart")
        .example("\"1 N\"")
        .add<&Options::strain>(
            "strain", "", "change of rest length over rest length at f = 1; positive lengthens")
        .above(-1)
        .add<&Options::pressure>("pressure", "Pa", "at f = 1; positive pushes on the body");
    add_time_options(schema);
    schema.check([](const Options& o, const FaultSink& faults) {
      const int given = o.force.has_value() + o.strain.has_value() + o.pressure.has_value();
      if (given != 1)
        faults.fault(o.pressure && given > 1 ? "pressure"
                     : o.strain              ? "strain"
                                             : "force",
                     "exactly one of force, strain and pressure");
      check_time_options(o, faults);
    });
    return schema;
  }

  explicit Actuation(const Options& options)
      : o_(options),
        time_(options),
        actuator_{options.force, options.strain, options.pressure, {}, {}} {}

  void declare(const LoadBody& body, const LoadSink& sink) {
    actuator_.declare(body, sink, o_.on);
    time_.corners(sink);
  }
  double factor(double time) const { return time_(time); }
  Vec3 answer(const WatchedMotion& motion, std::size_t n) const {
    return actuator_.answer(motion, n);
  }

 private:
  static constexpr std::string_view actuation_equation =
      "along each spring f(t) force, or k L0 f(t) strain; or -f(t) pressure A n on moving faces. f "
      "by form: constant: 1, reached in a straight line "
      "during rise; triangle: to 1 during rise, to 0 during fall; half_sine: sin(pi t / duration); "
      "harmonic: sin(2 pi frequency t + phase), growing "
      "during rise; table: straight lines between (times, values); t from start on, 0 before";

  Options o_;
  TimeFunction time_;
  Actuator actuator_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Actuation>(); }
