// Bars of cohesive material: one that two rims pull apart slowly, whose curve of softening is known
// in closed form (docs/theory/cohesive.md), and one whose ends fly apart.
#pragma once

#include <support/laws.hpp>
#include <support/scenes.hpp>

#include <memory>
#include <numbers>

namespace hyperlattice::test::cohesive_bar {

constexpr double young = 1e10, strength = 1e7, spacing = 1e-3;

/// The toughness of a material with l_ch = 3.6 b, and the material with these keys of the surface.
inline double fracture_energy(double poisson, double length) {
  const double modulus = young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson));
  return 3.6 * length * strength * strength / modulus * (1 + 0.175 * spacing / length);
}
inline Keys cohesive(double poisson, double length, const Keys& more = {}) {
  return {{"young", young},
          {"density", 2500},
          {"poisson", poisson},
          {"membrane", poisson < 0.25 ? "I-m" : "none"},
          {"failure", (Keys{{"type", "failures.cohesive"},
                            {"strength", strength},
                            {"fracture_energy", fracture_energy(poisson, length)},
                            {"length", length},
                            {"intact_near_supports", false}} +
                       more)
                          .json()}};
}

inline std::vector<double> damage_of(const Model& model, const Simulation& simulation) {
  std::vector<double> values(model.body.particles, 0);
  simulation.copy_damage(values);
  return values;
}

/// A bar of one cell by one cell that two rims pull apart slowly. The two
/// middle layers of cells are weaker by 0.5 %.
struct Bar {
  int half;  ///< length, cells
  std::unique_ptr<Plan> plan;
  std::unique_ptr<Simulation> simulation;

  /// `confined`: its particles do not move along y and z, as in a wide plate, so that its modulus
  /// is C11.
  Bar(int half_length, double poisson, double length, const std::string& precision, int threads = 1,
      bool confined = false)
      : half(half_length) {
    const double end = mm(2 * half);
    plan = plan_of(
        SceneBuilder{}
            .key("precision", precision)
            .lattice("lattices.cubic", spacing, box_mm(2 * half, 1, 1), {{"boundary", "cells"}})
            .material("materials.elastic", cohesive(poisson, length))
            .material("materials.elastic",
                      cohesive(poisson, length, {{"strength", 0.995 * strength}}) +
                          Keys{{"name", "weak"},
                               {"region", box({mm(half - 1), -1, -1}, {mm(half + 1), 1, 1})}})
            .load("loads.velocity", {{"name", "left"},
                                     {"on", "x_min"},
                                     {"axes", "x"},
                                     {"value", Vec3{-speed(end), 0, 0}},
                                     {"rise", 0.1 * time(end)}})
            .load("loads.velocity", {{"name", "right"},
                                     {"on", "x_max"},
                                     {"axes", "x"},
                                     {"value", Vec3{speed(end), 0, 0}},
                                     {"rise", 0.1 * time(end)}})
            .load("loads.fixed", {{"on", confined ? "all" : "y_min"}, {"axes", "y"}})
            .load("loads.fixed", {{"on", confined ? "all" : "z_min"}, {"axes", "z"}})
            .solver("solvers.explicit", {{"end_time", 1}})
            .text(),
        threads);
    simulation = std::make_unique<Simulation>(*plan->model, threads);
    simulation->set_damping(0, 0.3 * std::numbers::pi * 2000 / end);
  }
  /// Time of the test, s, in passages of waves, and the speed of a rim, m/s.
  static double time(double end) { return 250 * end / 2000; }
  double speed(double end) const { return 0.5 * 2.7 * strength / young * end / time(end); }

  /// Returns the stress of the rims, Pa.
  double stress() const {
    const std::vector<Vec3> forces = simulation->force_on_load();
    return (forces[0].x - forces[1].x) / 2 / (spacing * spacing);
  }
  /// Returns the growth of the length, m.
  double growth() const {
    std::vector<double> u;
    simulation->displacements(u);
    return u[3 * static_cast<std::size_t>(2 * half)] - u[0];
  }
};

/// A bar that is torn along z.
inline std::unique_ptr<Plan> torn_bar(double poisson, const std::string& precision = "double",
                                      const std::string& boundary = "cells") {
  return plan_of(SceneBuilder{}
                     .key("precision", precision)
                     .lattice("lattices.cubic", spacing, box_mm(3, 3, 20), {{"boundary", boundary}})
                     .material("materials.elastic", cohesive(poisson, 3e-3))
                     .solver("solvers.explicit", {{"end_time", 1}})
                     .text());
}

/// Lets the ends fly apart.
inline void set_tearing(const Model& model, Simulation& simulation) {
  std::vector<double> v = noise(3 * model.body.particles, 0.3);
  for (Particle p = 0; p < model.body.particles; ++p)
    v[3 * p + 2] += 12 * (model.body.position(p).z / 20e-3 - 0.4);
  simulation.set_velocities(v, model.degrees_of_freedom == 4
                                   ? std::vector<double>(model.body.particles, 0)
                                   : std::vector<double>{});
}

}  // namespace hyperlattice::test::cohesive_bar
