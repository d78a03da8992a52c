// A displacement and strain gauge between two regions: the change of the distance between the mean
// places of their particles, or of its component along a fixed direction.
#include <hyperlattice/fields.hpp>

namespace hyperlattice {
namespace {

class GaugeProbe {
 public:
  struct Options {
    RegionId from, to;
    std::optional<Vec3> direction;
  };

  static Schema<Options> schema() {
    return Schema<Options>("probes.gauge", "Elongation and strain between two regions, over time")
        .add<&Options::from>("from", "", "the particles at one end")
        .example("\"x_min\"")
        .add<&Options::to>("to", "", "the particles at the other end")
        .example("\"x_max\"")
        .add<&Options::direction>("direction", "",
                                  "a direction fixed in space, of any length, along which the "
                                  "ends move apart; the present line between them if left out")
        .nonzero()
        .equation(
            "R: from the mean place of one end to that of the other, undeformed; d: difference of "
            "their mean displacements; elongation = |R + d| - |R|, or d . direction; strain = "
            "elongation / |R|")
        .restrictions(
            "Without a direction a rigid rotation gives nothing. The length |R| is between mean "
            "places of particles: with the boundary \"particles\" these are half a spacing inside "
            "the faces of the body. Both ends must have different mean places.");
  }

  explicit GaugeProbe(const Options& options) : options_(options) {
    if (options.direction) direction_ = direction_of(*options.direction);
  }

  void begin(const OutputContext& context, const Snapshot& first, const ColumnSink& columns) {
    require_field(context, first, "displacement");
    const std::span<const Particle> from = context.particles(options_.from),
                                    to = context.particles(options_.to);
    if (from.empty() || to.empty())
      throw std::runtime_error(std::string(from.empty() ? "from" : "to") +
                               " that names a region with particles");
    from_.assign(from.begin(), from.end());
    to_.assign(to.begin(), to.end());
    rest_ = mean(first.positions, to_) - mean(first.positions, from_);
    if (!(norm(rest_) > 1e-9 * first.spacing))
      throw std::runtime_error("to whose mean place is not that of the end \"from\"");
    columns.column("elongation");
    columns.column("strain");
  }

  void sample(const Snapshot& snapshot, double* row) const {
    const std::span<const double> moved = require_field(snapshot, "displacement").values;
    const Vec3 apart = mean(moved, to_) - mean(moved, from_);
    row[0] = direction_ ? dot(apart, *direction_) : growth(apart);
    row[1] = row[0] / norm(rest_);
  }

 private:
  /// Returns |rest + apart| - |rest| without cancellation.
  double growth(Vec3 apart) const {
    return dot(apart, 2 * rest_ + apart) / (norm(rest_ + apart) + norm(rest_));
  }

  static Vec3 mean(std::span<const double> xyz, const std::vector<Particle>& particles) {
    Vec3 sum;
    for (const Particle particle : particles)
      sum += Vec3{xyz[3 * particle], xyz[3 * particle + 1], xyz[3 * particle + 2]};
    return sum / static_cast<double>(particles.size());
  }

  Options options_;
  std::optional<Vec3> direction_;  ///< of length 1
  std::vector<Particle> from_, to_;
  Vec3 rest_;  ///< m
};

}  // namespace
}  // namespace hyperlattice

HYPERLATTICE_PLUGIN("1.0") { plugin.add<hyperlattice::GaugeProbe>(); }
