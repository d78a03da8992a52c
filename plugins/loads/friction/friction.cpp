// Friction of cuts that close: a cut of the lattice that is pressed together carries compression as
// if it were not there, and shear up to Coulomb's limit. See closed_cut.hpp.
#include "closed_cut.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {
using namespace hyperlattice;

class Friction {
 public:
  struct Options {
    RegionId on;
    double angle = 0;
  };

  static Schema<Options> schema() {
    return Schema<Options>(
               "loads.friction",
               "Cuts of the lattice that close: compression, and friction of their faces")
        .equation(
            "closed (t_n < 0): |t_t| <= tan(angle) |t_n|, with the springs of the whole lattice; "
            "else t = 0")
        .source("Coulomb friction by a return mapping, as of a plastic body without hardening")
        .restrictions(
            "Grids with membrane \"none\" and the Poisson ratio of the springs alone. The closed "
            "springs are linear and do not break. Faces meet the places where they were at rest: "
            "slips must be small against the spacing, and rotations of the cut small. The energy "
            "balance counts the work of the faces as that of a load: friction takes energy from "
            "the body as negative work, and what closed springs store comes back")
        .add<&Options::on>("on", "", "the particles whose cut springs can close")
        .fallback("\"all\"")
        .add<&Options::angle>("angle", "rad", "friction angle; 0: smooth faces")
        .at_least(0)
        .below(std::numbers::pi / 2);
  }

  explicit Friction(const Options& o) : o_(o) {}

  void declare(const LoadBody& body, const LoadSink& sink) {
    const std::span<const SeveredSpring> found = body.cut_springs(o_.on);
    std::vector<SeveredSpring> springs(found.begin(), found.end());
    std::vector<Vec3> first_ends;
    first_ends.reserve(springs.size());
    for (const SeveredSpring& spring : springs) first_ends.push_back(body.position(spring.a));
    cut_ = friction::ClosedCut(std::move(springs), first_ends, body.spacing, std::tan(o_.angle));
    // Closed springs are those of the lattice without cuts, for which the critical step is stable.
    for (const Particle particle : cut_.particles()) sink.watch(particle);
    sink.remember(friction::ClosedCut::numbers * cut_.patches());
  }
  double factor(double) const { return 1; }
  void prepare(const WatchedMotion& motion) { cut_.find(motion.displacement, motion.memory); }
  Vec3 answer(const WatchedMotion&, std::size_t n) const { return cut_.force(n); }
  void update(const WatchedMotion&, std::span<double> memory) const {
    const std::span<const double> jumps = cut_.jumps();
    std::copy(jumps.begin(), jumps.end(), memory.begin());
  }

 private:
  Options o_;
  friction::ClosedCut cut_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Friction>(); }
