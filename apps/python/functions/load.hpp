// A load whose forces a Python function gives, once for each evaluation of all forces.
#pragma once

#include "function_options.hpp"

namespace hyperlattice::python {

class Load {
 public:
  struct Options : FunctionOptions {
    RegionId on;
    double stiffness = 0, viscosity = 0;
  };

  static Schema<Options> schema() {
    Schema<Options> schema("loads.python", "Forces on particles that a Python function gives");
    schema.equation("F = function(state)")
        .source(
            "the function of the scene. It gets the time, the places at rest, displacements and "
            "velocities, and returns a force, N, for each particle")
        .restrictions(
            "Python is called in every step, which is slow beside a built-in load. Only for "
            "scenes that Python runs")
        .add<&Options::on>("on", "", "the loaded particles")
        .add<&Options::stiffness>("stiffness", "N/m",
                                  "largest change of the force on a particle with its "
                                  "displacement; it enters the critical step")
        .at_least(0)
        .fallback("0")
        .add<&Options::viscosity>("viscosity", "N s/m",
                                  "largest change of the force on a particle with its velocity; it "
                                  "enters the critical step")
        .at_least(0)
        .fallback("0");
    return add_function_options(schema, "gives the forces")
        .check([](const Options& options, const FaultSink& faults) {
          check_function(options, faults);
        });
  }

  explicit Load(const Options& options) : o_(options), function_(found(options)) {}

  void declare(const LoadBody& body, const LoadSink& sink) {
    const std::span<const Particle> particles = body.particles(o_.on);
    std::vector<Vec3> positions;
    std::vector<double> masses, shares;
    for (const Particle particle : particles) {
      sink.watch(particle, {o_.stiffness, o_.viscosity});
      positions.push_back(body.position(particle));
      masses.push_back(body.mass(particle));
      shares.push_back(body.share(particle));
    }
    forces_.assign(particles.size(), {});
    function_->begin({particles, positions, masses, shares});
  }
  double factor(double) const { return 1; }
  void prepare(const WatchedMotion& motion) { function_->set_forces(motion, forces_); }
  Vec3 answer(const WatchedMotion&, std::size_t n) const { return forces_[n]; }

 private:
  Options o_;
  std::shared_ptr<PythonFunction> function_;
  std::vector<Vec3> forces_;  ///< on the watched particles, N
};

}  // namespace hyperlattice::python
