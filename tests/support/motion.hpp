// A scene whose stages run one after the other inside a test, which looks at the body on the way.
#pragma once

#include <engine/stage_calls.hpp>
#include <support/scenes.hpp>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace hyperlattice::test {

struct Motion {
  std::unique_ptr<Plan> plan;
  Simulation simulation;

  explicit Motion(const std::string& scene, int threads = 1)
      : plan(plan_of(scene, threads)), simulation(*plan->model, threads) {}
  /// Runs all stages. `look`: called at each observation.
  void go(const std::function<void()>& look = {}) {
    for (const PlannedStage& stage : plan->stages) {
      StageCalls::Hooks hooks;
      hooks.observe = look;
      StageCalls(*plan->model, simulation, stage, plan->threads, std::move(hooks)).run();
    }
  }
  const Model& model() const { return *plan->model; }
  double critical() const { return model().step_limit.time_step; }
  /// Mean displacement along x of the particles with the largest x.
  double end() const {
    const std::vector<double> u = displacements(simulation);
    double sum = 0, count = 0;
    for (Particle p = 0; p < model().body.particles; ++p)
      if (model().body.site(p).i == model().body.high.i) {
        sum += u[3 * p];
        ++count;
      }
    return sum / count;
  }
  Vec3 angular_momentum() const {
    const std::vector<double> u = displacements(simulation);
    std::vector<double> v;
    simulation.velocities(v);
    Vec3 sum;
    for (Particle p = 0; p < model().body.particles; ++p)
      sum += model().mass(p) *
             cross(model().body.position(p) + Vec3{u[3 * p], u[3 * p + 1], u[3 * p + 2]},
                   Vec3{v[3 * p], v[3 * p + 1], v[3 * p + 2]});
    return sum;
  }
};

}  // namespace hyperlattice::test
