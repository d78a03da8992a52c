// Bodies in a state of rest: a scene, its first solver, and the result.
#pragma once

#include "scenes.hpp"

#include <engine/stage_calls.hpp>
#include <state/force_sums.hpp>
#include <state/particle_stress.hpp>

namespace hyperlattice::test {

/// A scene that its first solver brings to rest.
struct AtRest {
  std::unique_ptr<Plan> plan;
  std::unique_ptr<Simulation> simulation;
  RestReport report;
  std::vector<double> u, heights;

  explicit AtRest(const std::string& scene, int threads = 1) : AtRest(plan_of(scene, threads)) {}
  explicit AtRest(std::unique_ptr<Plan> planned) : plan(std::move(planned)) {
    simulation = std::make_unique<Simulation>(*plan->model, plan->threads);
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

/// The forces that the solver left out of balance when it stopped at its tolerance.
class OutOfBalance {
 public:
  explicit OutOfBalance(const AtRest& body)
      : body_(body), forces_(internal_forces(PresentSprings(body.model(), *body.simulation))) {
    const std::vector<Vec3> internal = forces_,
                            external = body.simulation->external_forces(
                                [&]() -> const std::vector<Vec3>& { return internal; });
    for (Particle p = 0; p < forces_.size(); ++p) forces_[p] += external[p];
  }
  /// Returns their sum over these particles, with the moment about a point, m.
  Resultant on(const std::vector<Particle>& particles, Vec3 about) const {
    Resultant sum;
    for (const Particle p : particles) {
      const Vec3 moved{body_.u[3 * p], body_.u[3 * p + 1], body_.u[3 * p + 2]};
      sum.force += forces_[p];
      sum.moment += cross(body_.model().body.position(p) + moved - about, forces_[p]);
    }
    return sum;
  }

 private:
  const AtRest& body_;
  std::vector<Vec3> forces_;  ///< on each particle, N
};

/// A scene of the cubic lattice with these keys, and more stages.
inline std::string scene(const Keys& lattice, const Stages& stages) {
  return SceneBuilder{}.stage("lattices.cubic", lattice).stages(stages).text();
}

inline Stages elastic(double young, const Keys& more) {
  return stage("materials.elastic", Keys{{"density", 2000}, {"young", young}} + more);
}

inline const Stages to_rest = stage("solvers.static", {{"tolerance", 1e-8}});

}  // namespace hyperlattice::test
