// The force and moment through a plane: what the material beyond the plane, on the side of its
// normal, does to the material before it.
#include <hyperlattice/component.hpp>
#include <hyperlattice/load_cell.hpp>

#include <stdexcept>

namespace hyperlattice {
namespace {

class SectionProbe {
 public:
  struct Options {
    Vec3 point, normal;
    RegionId region;
    std::optional<Vec3> about;
    std::optional<double> area;
  };

  static Schema<Options> schema() {
    return Schema<Options>("probes.section", "Force and moment through a plane, over time")
        .add<&Options::point>("point", "m", "a point of the plane, in the undeformed body")
        .example("[\"3 mm\", 0, 0]")
        .add<&Options::normal>("normal", "", "direction across the plane, of any length")
        .example("[1, 0, 0]")
        .nonzero()
        .add<&Options::region>("region", "", "the part of the body that the plane cuts")
        .fallback("\"all\"")
        .add<&Options::about>("about", "m", "point of the moment; `point` if left out")
        .add<&Options::area>("area", "m2",
                             "undeformed area of the section, for the stress; that of the springs "
                             "that the plane cuts if left out")
        .positive()
        .equation(
            "force = sum f_s over the springs s that the plane cuts, f_s their pull on the end "
            "before the plane; moment = sum (x + u - about) x f_s at this end; stress = force . "
            "normal / area, positive in tension; area . m = normal . sum R_s over whole springs "
            "of class 0, m = 1/l in the cubic lattice")
        .restrictions(
            "The plane divides the particles by their undeformed places; particles on the plane "
            "are before it. In equilibrium the force is minus the sum of all loads on the material "
            "beyond, "
            "to round-off, for any direction of the plane. In motion the material beyond takes "
            "mass times acceleration of it. In a region, springs that leave the region do not "
            "count.");
  }

  explicit SectionProbe(const Options& options) : options_(options) {}

  void begin(const OutputContext& context, const Snapshot&, const ColumnSink& columns) {
    const Section section = context.section(options_.point, options_.normal, options_.region);
    if (section.springs == 0)
      throw std::runtime_error("point of a plane that cuts springs of the region");
    area_ = options_.area.value_or(section.area);
    cell_ = LoadCell(section.forces, options_.about.value_or(options_.point));
    cell_.set_area(options_.normal, area_);
    cell_.name_columns(columns);
    columns.column("area");
  }

  void sample(const Snapshot& snapshot, double* row) const {
    cell_.sample(snapshot, row);
    row[7] = area_;
  }

 private:
  Options options_;
  LoadCell cell_;
  double area_ = 0;
};

}  // namespace
}  // namespace hyperlattice

HYPERLATTICE_PLUGIN("1.0") { plugin.add<hyperlattice::SectionProbe>(); }
