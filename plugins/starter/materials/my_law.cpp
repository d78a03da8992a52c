// The material: its options, what they make of a lattice, its registration. E, nu, density and
// membrane, and their calibration, come from elastic_solid.
#include "my_law.hpp"

#include <hyperlattice/elastic_solid.hpp>
#include <hyperlattice/kernels/choose.hpp>

namespace {
using namespace hyperlattice;

class MyMaterial {
 public:
  struct Options : elastic_solid::Options {
    double wear = 0;
  };

  static constexpr std::string_view law = "my_law";

  static Schema<Options> schema() {
    Schema<Options> schema("materials.my_law", "Springs that wear out as they move");
    schema.equation("f = k exp(-p / wear) u, p the way that u has gone")
        .add<&Options::wear>("wear", "m",
                             "way that a spring's elongation goes while its stiffness falls to 1/e")
        .positive()
        .example("\"1 um\"");
    return Options::declare(schema);
  }

  explicit MyMaterial(const Options& options) : options_(options) {}

  MaterialConstants constants(const LatticeFacts& lattice) const {
    MaterialConstants constants = options_.constants(lattice);
    constants.set_law(MyLaw::Constants{options_.wear});
    return constants;
  }
  static KernelSet kernels(const KernelChoice& choice) { return kernels_for_processor(choice); }

 private:
  Options options_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<MyMaterial>(); }
