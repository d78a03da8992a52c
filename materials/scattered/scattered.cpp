// An elastic solid whose springs have random stiffnesses. Each base spring, with its cross spring,
// has k times a random factor of mean 1 and standard deviation of about 1.2 / modulus. Such a body
// is softer than a body of equal springs. To first order in the variance v of the factors
// (effective medium), its modulus is E (1 - s v). Here s is the mean fraction that a spring has in
// the total stiffness between its two ends, 1/3 in a lattice of nine springs a particle. The
// modulus lies between the bounds of Voigt, E, and Reuss, E (1 - v).
#include "scattered.hpp"

#include <hyperlattice/elastic_solid.hpp>
#include <hyperlattice/kernels/choose.hpp>

namespace {
using namespace hyperlattice;

class Scattered {
 public:
  struct Options : elastic_solid::Options {
    double modulus = 0;
    std::int64_t seed = 0;
  };

  static constexpr std::string_view law = "scattered";

  static Schema<Options> schema() {
    Schema<Options> schema("materials.scattered",
                           "Elastic springs whose stiffness scatters from spring to spring");
    schema
        .equation(
            "f = c k u, c = (-ln p)^(1 / modulus) / Gamma(1 + 1 / modulus), p from the seed and "
            "the spring's particles")
        .source("Weibull 1951, two parameters; the mean of c is 1")
        .restrictions(
            "springs of positive stiffness. young is what springs of the mean stiffness give; the "
            "body is softer, by about a third of the variance "
            "of c "
            "in the cubic lattice. Numbers belong to springs, not to places: another spacing or "
            "another shape has others")
        .add<&Options::modulus>(
            "modulus", "",
            "of Weibull: large ones scatter little; the standard deviation is about 1.2 / modulus")
        .example("8")
        .at_least(1)
        .add<&Options::seed>("seed", "", "of the numbers")
        .at_least(0)
        .at_most(1LL << 53)
        .fallback("1");
    return Options::declare(schema);
  }

  explicit Scattered(const Options& options) : options_(options) {}

  MaterialConstants constants(const LatticeFacts& lattice) const {
    MaterialConstants constants = options_.constants(lattice);
    for (const double ratio : constants.cross_ratio)
      if (ratio < 0)
        throw std::invalid_argument(
            "membrane of another kind, or a smaller poisson: negative springs that scatter make no "
            "stable lattice");
    constants.set_law(
        ScatteredLaw::Constants{options_.modulus, static_cast<double>(options_.seed)});
    return constants;
  }
  /// Returns the stable time step, s, of a lattice whose springs all have the largest possible
  /// factor.
  double stable_time_step(double elastic_step) const {
    constexpr double least_chance = 0x1p-53;
    return elastic_step /
           std::sqrt(std::max(1.0, ScatteredLaw::share(options_.modulus, least_chance)));
  }
  static KernelSet kernels(const KernelChoice& choice) { return kernels_for_processor(choice); }

 private:
  Options options_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Scattered>(); }
