// The force and moment with which a load acts on the body, or all loads on the particles of a
// region: the reading of a load cell at a support or at a platen.
#include <hyperlattice/component.hpp>
#include <hyperlattice/fields.hpp>
#include <hyperlattice/load_cell.hpp>

namespace hyperlattice {
namespace {

class ReactionProbe {
 public:
  struct Options {
    LoadOrRegion on;
    std::optional<Vec3> about, normal;
    std::optional<double> area;
  };

  static Schema<Options> schema() {
    return Schema<Options>("probes.reaction",
                           "Force and moment of a load, or of all loads on a region, over time")
        .add<&Options::on>("on", "",
                           "the name of a load, or a region; a load counts first if both have "
                           "the name. A load without a name is called as the last part of its "
                           "type, the second such load with _2 behind it; where there are several, "
                           "the first needs a name to be chosen")
        .example("\"x_min\"")
        .add<&Options::about>("about", "m",
                              "point of the moment; the mean undeformed place of the particles if "
                              "left out")
        .add<&Options::area>("area", "m2", "undeformed area; gives the column stress")
        .positive()
        .add<&Options::normal>("normal", "",
                               "direction in which the stress is positive, such as the outward "
                               "normal of a face that is pulled")
        .nonzero()
        .equation(
            "force = sum F_i; moment = sum (x_i + u_i - about) x F_i; F_i: what the load pushes "
            "particle i with; for prescribed motion m_i a_i less all other forces on i (in "
            "equilibrium minus the internal force); for a body acceleration g: m_i g. stress = "
            "force . normal "
            "/ area")
        .restrictions(
            "On a region the forces of all loads on its particles count. Particles that no load "
            "touches count nothing: the force inside a body is that of probes.section. On the "
            "way of a static stage whose start is not in equilibrium, the forces that hold this "
            "start in "
            "place do not count.")
        .check([](const Options& options, const FaultSink& faults) {
          if (options.area.has_value() != options.normal.has_value())
            faults.fault(options.area ? "normal" : "area",
                         "\"area\" and \"normal\" together, or neither of them");
        });
  }

  explicit ReactionProbe(const Options& options) : options_(options) {}

  void begin(const OutputContext& context, const Snapshot& first, const ColumnSink& columns) {
    const std::span<const Particle> particles = context.particles(options_.on);
    if (particles.empty())
      throw std::runtime_error(options_.on.is_load() ? "the load acts on no particle"
                                                     : "no particle lies in the region");
    Vec3 centre;
    for (const Particle particle : particles)
      centre += position_of(first, particle) / static_cast<double>(particles.size());
    cell_ = LoadCell(context.forces_on(options_.on), options_.about.value_or(centre));
    if (options_.area) cell_.set_area(*options_.normal, *options_.area);
    cell_.name_columns(columns);
  }

  void sample(const Snapshot& snapshot, double* row) const { cell_.sample(snapshot, row); }

 private:
  Options options_;
  LoadCell cell_;
};

}  // namespace
}  // namespace hyperlattice

HYPERLATTICE_PLUGIN("1.0") { plugin.add<hyperlattice::ReactionProbe>(); }
