// Bodies of cells for tests: shapes given by their cells, scenes of these shapes, and the forces
// that the kernels compute.
#pragma once

#include <support/scenes.hpp>

#include <array>
#include <map>
#include <tuple>

namespace hyperlattice::test {

using CellIndex = std::array<int, 3>;

/// A shape in cells of 1 mm: as a scene describes it, and as a test of the cells' centres.
struct CellShape {
  const char* name;
  Json shape;
  std::function<bool(double x, double y, double z)> holds;  ///< is the point (mm) inside?

  /// Lists all cells of the shape by their index from the origin.
  std::vector<CellIndex> cells() const {
    std::vector<CellIndex> found;
    for (int k = -10; k < 10; ++k)
      for (int j = -10; j < 10; ++j)
        for (int i = -10; i < 20; ++i)
          if (holds(i + 0.5, j + 0.5, k + 0.5)) found.push_back({i, j, k});
    return found;
  }
};

/// A box from one corner of cells to another.
inline Json box_of_cells(const CellIndex& low, const CellIndex& high) {
  const auto corner = [](const CellIndex& c) { return Vec3{mm(c[0]), mm(c[1]), mm(c[2])}; };
  return box(corner(low), corner(high));
}

/// Returns a function that says whether a point (mm) is in the box.
inline auto in_box(CellIndex low, CellIndex high) {
  return [low, high](double x, double y, double z) {
    return low[0] < x && x < high[0] && low[1] < y && y < high[1] && low[2] < z && z < high[2];
  };
}

inline const std::vector<CellShape>& cell_shapes() {
  const auto both = [](const char* name, CellIndex low_a, CellIndex high_a, CellIndex low_b,
                       CellIndex high_b) {
    const auto a = in_box(low_a, high_a), b = in_box(low_b, high_b);
    return CellShape{name,
                     {{"union", {box_of_cells(low_a, high_a), box_of_cells(low_b, high_b)}}},
                     [a, b](double x, double y, double z) { return a(x, y, z) || b(x, y, z); }};
  };
  const auto without = [](const char* name, CellIndex low_a, CellIndex high_a, CellIndex low_b,
                          CellIndex high_b) {
    const auto a = in_box(low_a, high_a), b = in_box(low_b, high_b);
    return CellShape{name,
                     {{"difference", {box_of_cells(low_a, high_a), box_of_cells(low_b, high_b)}}},
                     [a, b](double x, double y, double z) { return a(x, y, z) && !b(x, y, z); }};
  };
  static const std::vector<CellShape> all{
      {"one_cell", box_of_cells({0, 0, 0}, {1, 1, 1}), in_box({0, 0, 0}, {1, 1, 1})},
      {"box", box_of_cells({0, 0, 0}, {17, 3, 4}), in_box({0, 0, 0}, {17, 3, 4})},
      {"L",
       {{"difference", {box_of_cells({0, 0, 0}, {6, 6, 3}), box_of_cells({2, 2, -1}, {7, 7, 4})}}},
       [](double x, double y, double z) {
         return in_box({0, 0, 0}, {6, 6, 3})(x, y, z) && !(x > 2 && y > 2);
       }},
      without("cavity", {0, 0, 0}, {9, 5, 5}, {2, 2, 2}, {5, 3, 4}),
      without("slit_of_one_cell", {0, 0, 0}, {9, 4, 4}, {4, 1, 0}, {5, 4, 4}),
      {"sphere",
       {{"sphere", {{"radius", 4.4e-3}}}},
       [](double x, double y, double z) { return x * x + y * y + z * z < 4.4 * 4.4; }},
      both("touching_in_an_edge", {0, 0, 0}, {2, 2, 2}, {2, 2, 0}, {4, 4, 2}),
      both("touching_in_a_corner", {0, 0, 0}, {2, 2, 2}, {2, 2, 2}, {4, 3, 4}),
  };
  return all;
}

/// A scene of this shape, filled with cells of 1 mm.
inline std::string scene_of_cells(const Json& shape, const Keys& material,
                                  const Stages& stages = {}) {
  return SceneBuilder{}
      .lattice("lattices.cubic", 1e-3, shape, {{"boundary", "cells"}, {"anchor", {0, 0, 0}}})
      .material("materials.elastic", Keys{{"young", 1e10}, {"density", 2500}} + material)
      .stages(stages)
      .solver("solvers.explicit", {{"end_time", 1e-6}})
      .text();
}

/// A random part of each cell of a shape, from 6 to 94 % of its volume; each fifth cell is whole.
inline Json random_parts(const CellShape& shape) {
  std::mt19937_64 random(11);
  Json boxes = Json::array();
  for (const CellIndex& cell : shape.cells()) {
    const double part = static_cast<double>(random() >> 11) * 0x1p-53;
    // The parts of two cells do not touch; whole cells overlap a little.
    const bool is_whole = part > 0.8;
    const double gap = is_whole ? -1e-3 : 0.01, height = is_whole ? 1 + 2e-3 : 0.07 + 1.1 * part;
    const Vec3 low{cell[0] + gap, cell[1] + gap, cell[2] + gap},
        high{cell[0] + 1 - gap, cell[1] + 1 - gap, low.z + height};
    boxes.push_back(box(1e-3 * low, 1e-3 * high));
  }
  return {{"union", boxes}};
}

/// A scene of this shape, filled with partial cells of 1 mm.
inline std::string scene_of_partial_cells(const Json& shape, const Keys& material,
                                          const Stages& stages = {}) {
  return SceneBuilder{}
      .lattice("lattices.cubic", 1e-3, shape,
               {{"boundary", "partial_cells"}, {"anchor", {0, 0, 0}}})
      .material("materials.elastic", Keys{{"young", 1e10}, {"density", 2500}} + material)
      .stages(stages)
      .solver("solvers.explicit", {{"end_time", 1e-6}})
      .text();
}

/// Returns the cell corner nearest to a particle.
inline CellIndex corner_of(const Model& model, Particle particle) {
  const Vec3 x = model.body.position(particle);
  return {static_cast<int>(std::lround(1e3 * x.x)), static_cast<int>(std::lround(1e3 * x.y)),
          static_cast<int>(std::lround(1e3 * x.z))};
}

/// Maps each cell corner to the particle on it.
inline std::map<CellIndex, Particle> particles_by_corner(const Model& model) {
  std::map<CellIndex, Particle> found;
  for (Particle p = 0; p < model.body.particles; ++p) found[corner_of(model, p)] = p;
  return found;
}

/// Components x, y, z and height.
using Force = std::array<double, 4>;

/// The forces on particles at rest with these displacements and heights. One step from rest gives
/// each particle a momentum; the force follows from it.
inline std::vector<Force> forces(const Model& model, const std::vector<double>& u,
                                 const std::vector<double>& heights, int threads = 1) {
  Simulation simulation(model, threads);
  simulation.set_displacements(u, heights);
  const double dt = model.step_limit.time_step;
  simulation.step(dt);
  std::vector<double> velocity, rate;
  simulation.velocities(velocity);
  simulation.height_rates(rate);
  std::vector<Force> all(model.body.particles);
  for (Particle p = 0; p < model.body.particles; ++p) {
    const double m = model.mass(p);
    for (std::size_t c = 0; c < 3; ++c) all[p][c] = 2 * m * velocity[3 * p + c] / dt;
    all[p][3] = rate.empty() ? 0 : 2 * m * rate[p] / dt;
  }
  return all;
}

}  // namespace hyperlattice::test
