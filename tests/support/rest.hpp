// Bodies in a state of rest: a scene, its first solver, and the result.
#pragma once

#include "scenes.hpp"

#include <engine/stage_calls.hpp>

#include <sstream>

namespace hyperlattice::test {

/// A scene that its first solver brings to rest.
struct AtRest {
  std::unique_ptr<Plan> plan;
  std::unique_ptr<Simulation> simulation;
  RestReport report;
  std::vector<double> u, heights;

  explicit AtRest(const std::string& scene, int threads = 1) : plan(plan_of(scene, threads)) {
    simulation = std::make_unique<Simulation>(*plan->model, threads);
    report = bring_to_rest(*plan, *simulation);
    u = displacements(*simulation);
    simulation->heights(heights);
  }
  const Model& model() const { return *plan->model; }
  /// Mean displacement along an axis of the particles for which chosen(site) holds.
  template <class Chosen>
  double mean(std::size_t axis, const Chosen& chosen) const {
    double sum = 0, count = 0;
    for (Particle p = 0; p < model().body.particles; ++p)
      if (chosen(model().body.site(p))) {
        sum += u[3 * p + axis];
        ++count;
      }
    return sum / count;
  }
};

inline std::string number(double value) {
  std::ostringstream text;
  text.precision(17);
  text << value;
  return text.str();
}

inline std::string box(Vec3 low, Vec3 high) {
  const auto corner = [](Vec3 v) {
    return "[" + number(v.x) + ", " + number(v.y) + ", " + number(v.z) + "]";
  };
  return R"({ "box": { "low": )" + corner(low) + R"(, "high": )" + corner(high) + " } }";
}

inline std::string scene(const std::string& lattice, const std::string& stages) {
  return R"({ "format": "hyperlattice/1", "pipeline": [ { "type": "lattices.cubic", )" + lattice +
         " },\n" + stages + " ] }";
}

inline std::string elastic(double young, const std::string& more) {
  return R"({ "type": "materials.elastic", "density": 2000, "young": )" + number(young) + ", " +
         more + " },\n";
}

inline const char* const to_rest = R"({ "type": "solvers.static", "tolerance": 1e-8 })";

}  // namespace hyperlattice::test
