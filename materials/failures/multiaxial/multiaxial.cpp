// A surface through four measured strengths: T in uniaxial tension, C in uniaxial compression, S in
// shear, B in equal biaxial tension. It is the cone of Drucker and Prager with one limit more for
// tension and for compression:
//   ratio = a sqrt(3 J2) + b I1 + c <s1> + d <-s3>,
//   a = (1/T + 1/C - 1/S) / (2 - sqrt(3)),   b = 1/B - 1/T,   c = 1/T - a - b,   d = 1/C - a + b.
// It is convex if a, c and d are not negative. a depends on S only, and b on B only. If the
// strengths give no convex surface, the nearest convex one is taken, with the given T and C and
// with the least squares of the relative errors of S and B; an error above 1 % is refused. With
// c = d = 0 it is the cone, with a = b = 0 the limits of s1 and of -s3 together.
#include <hyperlattice/strength_surface.hpp>

#include <algorithm>
#include <cstdio>
#include <string>

namespace {
using namespace hyperlattice;

/// a and b, 1/Pa.
struct Slopes {
  double shear = 0, pressure = 0;
};

class Multiaxial {
 public:
  struct Options : CohesiveOptions {
    double compressive_strength = 0, shear_strength = 0, biaxial_strength = 0;
  };

  static Schema<Options> schema() {
    Schema<Options> schema("failures.multiaxial",
                           "Damage that starts at a surface through strengths in tension, "
                           "compression, shear and biaxial tension");
    return CohesiveOptions::declare(schema)
        .add<&Options::compressive_strength>("compressive_strength", "Pa",
                                             "C, strength in uniaxial compression")
        .positive()
        .example("\"40 MPa\"")
        .add<&Options::shear_strength>("shear_strength", "Pa", "S, strength in pure shear")
        .positive()
        .example("\"3.9 MPa\"")
        .add<&Options::biaxial_strength>("biaxial_strength", "Pa",
                                         "B, strength in equal biaxial tension")
        .positive()
        .example("\"3.2 MPa\"")
        .equation(
            "ratio = a sqrt(3 J2) + b I1 + c <s1> + d <-s3>, at least 0; a, b, c, d from the four "
            "strengths")
        .source("Drucker and Prager 1952, with limits of s1 and s3 added; damage: Wu 2017")
        .restrictions(
            "the surface must be convex: if the four strengths give no convex one, shear_strength "
            "and biaxial_strength are met as nearly as possible, to 1 % or the scene is refused")
        .check([](const Options& o, const FaultSink& faults) { check(o, faults); });
  }

  explicit Multiaxial(const Options& o)
      : slopes_(fit(o)),
        tension_(1 / o.strength - slopes_.shear - slopes_.pressure),
        compression_(1 / o.compressive_strength - slopes_.shear + slopes_.pressure) {}

  double ratio(const PrincipalStress& stress) const {
    const double sum = slopes_.shear * stress.von_mises() + slopes_.pressure * stress.trace() +
                       tension_ * std::max(stress.first, 0.0) +
                       compression_ * std::max(-stress.third, 0.0);
    return std::max(sum, 0.0);
  }

 private:
  static constexpr double shear_rest = 2 - 1.7320508075688772;  // 2 - sqrt(3)

  /// Returns the relative errors of S and B on a surface, as 1 less the ratio there.
  static Slopes errors(const Options& o, const Slopes& of) {
    const double sum = 1 / o.strength + 1 / o.compressive_strength;
    return {o.shear_strength * (sum - shear_rest * of.shear) - 1,
            o.biaxial_strength * (1 / o.strength + of.pressure) - 1};
  }

  /// Returns the slopes of the convex surface nearest to the four strengths.
  static Slopes fit(const Options& o) {
    const double tension = 1 / o.strength, compression = 1 / o.compressive_strength;
    const Slopes exact{(tension + compression - 1 / o.shear_strength) / shear_rest,
                       1 / o.biaxial_strength - tension};
    if (exact.shear >= 0 && exact.shear + exact.pressure <= tension &&
        exact.shear - exact.pressure <= compression)
      return exact;
    // The convex surfaces are a triangle of slopes; the nearest one is on an edge.
    const Slopes cone{(tension + compression) / 2, (tension - compression) / 2},
        limit_of_tension{0, tension}, limit_of_compression{0, -compression};
    Slopes nearest;
    double least = infinity;
    for (const auto& [from, to] :
         {std::pair(cone, limit_of_tension), std::pair(cone, limit_of_compression),
          std::pair(limit_of_tension, limit_of_compression)}) {
      // Errors are linear in the slopes.
      const Slopes begin = errors(o, from), end = errors(o, to);
      const double x = end.shear - begin.shear, y = end.pressure - begin.pressure;
      const double part =
          std::clamp(-(begin.shear * x + begin.pressure * y) / (x * x + y * y), 0.0, 1.0);
      const Slopes here{from.shear + part * (to.shear - from.shear),
                        from.pressure + part * (to.pressure - from.pressure)};
      const Slopes error = errors(o, here);
      const double square = error.shear * error.shear + error.pressure * error.pressure;
      if (square < least) {
        least = square;
        nearest = here;
      }
    }
    return nearest;
  }

  static void check(const Options& o, const FaultSink& faults) {
    if (o.compressive_strength < o.strength)
      return faults.fault("compressive_strength", "at least the strength in tension");
    constexpr double most = 0.01;
    const Slopes error = errors(o, fit(o));
    // The nearest surface has S / (1 + error).
    const auto check_one = [&](const char* option, double given, double off) {
      if (std::abs(off) <= most) return;
      char text[160];
      std::snprintf(text, sizeof text,
                    "about %.4g Pa, that of the nearest convex surface through the other strengths",
                    given / (1 + off));
      faults.fault(option, text);
    };
    check_one("shear_strength", o.shear_strength, error.shear);
    check_one("biaxial_strength", o.biaxial_strength, error.pressure);
  }

  Slopes slopes_;
  double tension_, compression_;  // c and d, 1/Pa
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Multiaxial>(); }
