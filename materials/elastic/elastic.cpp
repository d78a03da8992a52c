// A linear elastic solid: from Young's modulus E and the Poisson ratio nu to the stiffness k of the base springs and lambda, the stiffness of
// the springs in the fourth dimension relative to k. Closed forms of the infinite cubic lattice (hyperlattice/calibration.hpp):
//   I-m: lambda = 7 (1 - 4 nu) / (1 + 5 nu),  k = 0.4 E l / eta,  eta = (18/5) (1 + nu) (1 - 2 nu) / (1 + 5 nu)
// E is the modulus of one layer, and every particle has the mass density * l^3.
#include <hyperlattice/kernels/choose.hpp>
#include <hyperlattice/membrane.hpp>

#include <stdexcept>

namespace {
using namespace hyperlattice;

enum class Stiffness : std::uint32_t { bulk, eq15 };
constexpr std::string_view stiffness_names[] = {"bulk", "eq15"};

class Elastic {
 public:
  struct Options : MembraneOptions {
    double young = 0, density = 0;
    Stiffness stiffness = Stiffness::bulk;
  };

  static constexpr std::string_view law = "elastic";

  static Schema<Options> schema() {
    Schema<Options> schema("materials.elastic", "Linear elastic springs, from Young's modulus and the Poisson ratio");
    schema.equation("f = k u; k = 0.4 E l / eta(lambda); I-m: lambda = 7 (1 - 4 nu) / (1 + 5 nu)")
        .source("Zhao 2017, equations (1) to (5), (10) to (15), (31); closed forms of the infinite lattice")
        .restrictions(
            "the cubic lattice; a Poisson ratio within the membrane's reach: I (-0.212, 0.25], II (-0.5, 0.25], I-m (-0.2, 0.25], III (0, 0.267), "
            "IV (0, 0.333), none 0.25. Only I-m is isotropic; for the others E and nu hold along [100]")
        .add<&Options::young>("young", "Pa", "Young's modulus of the body")
        .positive()
        .add<&Options::density>("density", "kg/m3", "mass density")
        .positive();
    add_membrane_options(schema);
    return schema.add<&Options::stiffness>("stiffness", "", "bulk: k of the infinite lattice; eq15: equation (15) with the springs that the body has")
        .choices(stiffness_names)
        .fallback("\"bulk\"")
        .check(check_membrane_options<Options>);
  }

  explicit Elastic(const Options& options) : o_(options) {}

  MaterialConstants constants(const LatticeFacts& lattice) const {
    if (lattice.spring_classes != 2 || lattice.neighbours.size() != 9 || lattice.membrane_distance != lattice.spacing)
      throw std::invalid_argument("materials.elastic knows the cubic lattice of 18 neighbours only");
    const calibration::Ratios ratios = o_.ratios();
    MaterialConstants constants;
    constants.density = o_.density;
    constants.base_stiffness = stiffness(lattice, o_.modulus_ratio());
    constants.cross_ratio[0] = ratios.beta;
    constants.cross_ratio[1] = ratios.gamma;
    constants.alpha_ratio = ratios.clamped ? 0 : ratios.alpha;
    constants.clamped = ratios.clamped && constants.has_cross_springs();
    return constants;
  }

  static KernelSet kernels(const KernelChoice& choice) { return kernels_for_processor(choice); }

 private:
  double stiffness(const LatticeFacts& lattice, double eta) const {
    const double l = lattice.spacing;
    if (o_.stiffness == Stiffness::bulk) return calibration::stiffness_bulk(o_.young, l, eta);
    const double squares = l * l * (static_cast<double>(lattice.springs[0]) + 2 * static_cast<double>(lattice.springs[1]));
    if (squares == 0) throw std::invalid_argument("stiffness eq15 needs a body that has springs");
    return calibration::stiffness_eq15(o_.young, static_cast<double>(lattice.particles) * lattice.site_volume, squares, eta);
  }

  Options o_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Elastic>(); }
