// A viscoelastic solid after Kelvin and Voigt: each spring has a damper in parallel,
//   f = k (u + tau du/dt).
// Base and cross springs have the same tau, so a wave of angular frequency w has the damping ratio
// w tau / 2. The law uses the rate of the previous step. For one mode,
//   u(n+1) - 2 u(n) + u(n-1) = -(w dt)^2 (u(n) + tau (u(n) - u(n-1)) / dt)
// has its roots inside the unit circle if dt^2 + 2 tau dt < 4 / w^2 = dt_c^2. This sets the stable
// step.
#include "viscous.hpp"

#include <hyperlattice/elastic_solid.hpp>
#include <hyperlattice/kernels/choose.hpp>

namespace {
using namespace hyperlattice;

class Viscous {
 public:
  struct Options : elastic_solid::Options {
    double time = 0;
  };

  static constexpr std::string_view law = "viscous";

  static Schema<Options> schema() {
    Schema<Options> schema("materials.viscous",
                           "Viscoelastic springs after Kelvin and Voigt: a damper beside each");
    schema
        .equation(
            "f = k (u + time du/dt); damping ratio of a wave of angular frequency w: w time / 2")
        .source(
            "Kelvin-Voigt element; stable step: linear stability of central differences with the "
            "rate of the step before")
        .restrictions("the stable step is smaller than that of elastic springs")
        .add<&Options::time>(
            "time", "s",
            "viscosity over stiffness of each spring: the time in which a damped creep decays")
        .example("\"0.5 us\"")
        .at_least(0);
    return Options::declare(schema);
  }

  explicit Viscous(const Options& options) : options_(options) {}

  MaterialConstants constants(const LatticeFacts& lattice) const {
    MaterialConstants constants = options_.constants(lattice);
    constants.set_law(ViscousLaw::Constants{options_.time});
    return constants;
  }
  double stable_time_step(double elastic_step) const {
    return std::sqrt(options_.time * options_.time + elastic_step * elastic_step) - options_.time;
  }
  static KernelSet kernels(const KernelChoice& choice) { return kernels_for_processor(choice); }

 private:
  Options options_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Viscous>(); }
