// Laws with constants and memory for tests, and bodies whose strains bring out the effect of each
// law.
#pragma once

#include <support/scenes.hpp>

#include <algorithm>

namespace hyperlattice::test {

struct LawCase {
  const char* name;
  const char* material;  ///< type and keys; at strains of 1e-3 the effect of the law shows
};

/// A scene of a lattice stage, the type and keys of a material after young and density, and more
/// stages.
inline std::string law_scene(const Stages& lattice, const Keys& material,
                             const Stages& stages = {}) {
  return SceneBuilder{}
      .stages(lattice)
      .stages(Keys{{"young", 1e10}, {"density", 2500}} + material)
      .stages(stages)
      .solver("solvers.explicit", {{"end_time", 1}})
      .text();
}

inline const Keys law_failure = {{"failure", {{"type", "failures.elongation"}, {"limit", 1.2e-6}}}};

/// The number of springs that a criterion removed; springs that softened stay.
inline std::size_t removed_springs(const Simulation& simulation) {
  const std::vector<Breakage>& all = simulation.breakages();
  return static_cast<std::size_t>(std::count_if(
      all.begin(), all.end(), [](const Breakage& breakage) { return !breakage.softened; }));
}

struct Ended {
  EnergyBalance balance;
  std::uint64_t hash = 0;
  std::size_t broken = 0;
};
/// Starts a body with random velocities (at most `speed`, m/s) and takes `steps` steps of `share`
/// times the critical time step.
inline Ended shaken(const Plan& plan, double share, int steps, int threads, double speed = 4) {
  Simulation simulation(*plan.model, threads);
  simulation.set_velocities(noise(3 * plan.model->body.particles, speed, 3),
                            plan.model->degrees_of_freedom == 4
                                ? std::vector<double>(plan.model->body.particles, 0)
                                : std::vector<double>{});
  for (int n = 0; n < steps; ++n) simulation.step(share * plan.model->step_limit.time_step);
  return {simulation.balance(), simulation.hash(), removed_springs(simulation)};
}

/// Moves a body along a path of displacements, one step of 1e-8 s for each, and returns the forces
/// on all particles, x y z each.
class LedBody {
 public:
  explicit LedBody(const Model& model, int threads = 1)
      : model_(model), simulation_(model, threads) {}
  std::vector<double> forces(const std::vector<double>& displacements) {
    const std::vector<double> heights(model_.degrees_of_freedom == 4 ? model_.body.particles : 0,
                                      0.0);
    simulation_.set_displacements(displacements, heights);
    simulation_.set_velocities(std::vector<double>(displacements.size(), 0.0), heights);
    const double kick = simulation_.steps() == 0 ? time_step / 2 : time_step;
    simulation_.step(time_step);
    std::vector<double> found;
    simulation_.velocities(found);
    for (std::size_t n = 0; n < found.size(); ++n) found[n] *= model_.mass(n / 3) / kick;
    return found;
  }
  const Simulation& simulation() const { return simulation_; }
  static constexpr double time_step = 1e-8;

 private:
  const Model& model_;
  Simulation simulation_;
};

}  // namespace hyperlattice::test
