// A linear elastic solid: springs with the law f = k u. The stiffness k follows from Young's
// modulus and the Poisson ratio (hyperlattice/elastic_solid.hpp).
#include <hyperlattice/elastic_solid.hpp>
#include <hyperlattice/kernels/choose.hpp>

namespace {
using namespace hyperlattice;

class Elastic {
 public:
  using Options = elastic_solid::Options;

  static constexpr std::string_view law = "elastic";

  static Schema<Options> schema() {
    Schema<Options> schema("materials.elastic",
                           "Linear elastic springs, from Young's modulus and the Poisson ratio");
    schema
        .equation(
            "f = k u; cubic lattice: k = 0.4 E l / eta(lambda); I-m: lambda = 7 (1 - 4 nu) / (1 + "
            "5 nu); other lattices: k and lambda from their "
            "springs; without a membrane K_v = k / l (4 nu - 1) / (1 - 2 nu)")
        .source(
            "Zhao 2017, equations (1) to (5), (10) to (15), (31); closed forms of the infinite "
            "lattice")
        .restrictions(
            "a Poisson ratio within the membrane's reach; in the cubic lattice: I (-0.212, 0.25], "
            "II (-0.5, 0.25], I-m (-0.2, 0.25], III (0, 0.267), "
            "IV (0, 0.333), none 0.25 to 0.5 (and -1 to 0.5 with volumetric). I-m and none are "
            "isotropic; for the others E and nu hold along "
            "[100]. Beyond it the lattice is unstable, and runs "
            "only if the scene says allow_unstable");
    return Options::declare(schema);
  }

  explicit Elastic(const Options& options) : options_(options) {}

  MaterialConstants constants(const LatticeFacts& lattice) const {
    return options_.constants(lattice);
  }
  static KernelSet kernels(const KernelChoice& choice) { return kernels_for_processor(choice); }

 private:
  Options options_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Elastic>(); }
