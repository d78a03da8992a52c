// A block for loads of any kind, and the sums of its motion.
#pragma once

#include <support/scenes.hpp>

namespace hyperlattice::test {

/// A block of 1 mm cells, soft as rubber or stiff as stone, with more stages.
inline std::string loaded_block(int nx, int ny, int nz, const Stages& stages, double young = 1e10,
                                const Keys& material = {{"poisson", 0.25}},
                                const Keys& lattice = {{"boundary", "particles"}}) {
  return SceneBuilder{}
      .region("half", {{"half_space", {{"point", {0, 0, mm(nz / 2)}}, {"normal", {0, 0, 1}}}}})
      .lattice("lattices.cubic", 1e-3, box_mm(nx, ny, nz), lattice)
      .material("materials.elastic", Keys{{"density", 2500}, {"young", young}} + material)
      .stages(stages)
      .solver("solvers.explicit", {{"end_time", 1e-6}})
      .text();
}

/// Sums over all particles.
struct Sums {
  Vec3 momentum, spin;  ///< angular momentum about the origin
  double size = 0;      ///< sum of m |v|
};
inline Sums sums(const Model& model, const Simulation& simulation) {
  std::vector<double> u, v;
  simulation.displacements(u);
  simulation.velocities(v);
  Sums all;
  for (Particle p = 0; p < model.body.particles; ++p) {
    const Vec3 mv = model.mass(p) * Vec3{v[3 * p], v[3 * p + 1], v[3 * p + 2]};
    all.momentum = all.momentum + mv;
    all.spin =
        all.spin + cross(model.body.position(p) + Vec3{u[3 * p], u[3 * p + 1], u[3 * p + 2]}, mv);
    all.size += norm(mv);
  }
  return all;
}

}  // namespace hyperlattice::test
