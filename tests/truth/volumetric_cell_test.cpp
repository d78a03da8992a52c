// The volumetric energy of one cell: its forces are the derivatives of its energy, add up to no
// force and no moment, turn with the cell, and keep their digits at any size of the displacements.
#include <hyperlattice/volumetric_cell.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace volumetric_cell_test {
using namespace hyperlattice;

constexpr double l = 2e-3, K = 3e9;

Vec3 place(std::size_t corner) {
  return l / 2 * Vec3{corner_sign(corner, 0), corner_sign(corner, 1), corner_sign(corner, 2)};
}

CellCorners noise(double amplitude, unsigned seed = 1) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> part(-amplitude, amplitude);
  CellCorners all;
  for (Vec3& u : all) u = {part(random), part(random), part(random)};
  return all;
}

/// Displacements of a cell that is stretched by `stretch` along all axes.
CellCorners stretched(double stretch) {
  CellCorners all;
  for (std::size_t n = 0; n < 8; ++n) all[n] = (stretch - 1) * place(n);
  return all;
}

double largest(const CellCorners& forces) {
  double found = 0;
  for (const Vec3& f : forces) found = std::max(found, norm(f));
  return found;
}

TEST(VolumetricCell, ForcesAreTheDerivativesOfTheEnergy) {
  for (const double amplitude : {0.01, 0.1, 0.3})
    for (unsigned seed = 1; seed < 6; ++seed) {
      const CellCorners u = noise(amplitude * l, seed);
      const CellResponse cell = cell_response(u, l, K);
      const double h = 1e-6 * l;
      for (std::size_t n = 0; n < 8; ++n)
        for (int c = 0; c < 3; ++c) {
          CellCorners more = u, less = u;
          more[n][c] += h;
          less[n][c] -= h;
          const double slope =
              (cell_response(more, l, K).energy - cell_response(less, l, K).energy) / (2 * h);
          EXPECT_NEAR(cell.force[n][c], -slope, 1e-8 * largest(cell.force));
        }
    }
}

TEST(VolumetricCell, ForcesHaveNoSumAndNoMoment) {
  for (unsigned seed = 1; seed < 20; ++seed) {
    const CellCorners u = noise(0.3 * l, seed);
    const CellResponse cell = cell_response(u, l, K);
    Vec3 sum, moment;
    for (std::size_t n = 0; n < 8; ++n) {
      sum += cell.force[n];
      moment += cross(place(n) + u[n], cell.force[n]);
    }
    EXPECT_LT(norm(sum), 1e-13 * largest(cell.force));
    EXPECT_LT(norm(moment), 1e-13 * largest(cell.force) * l);
  }
}

TEST(VolumetricCell, TurnsWithTheCell) {
  const CellCorners u = noise(0.2 * l, 3);
  const CellResponse before = cell_response(u, l, K);
  const double angle = 1.3, c = std::cos(angle), s = std::sin(angle);
  const auto turned = [&](Vec3 x) { return Vec3{c * x.x - s * x.y, s * x.x + c * x.y, x.z}; };
  CellCorners after;
  for (std::size_t n = 0; n < 8; ++n) after[n] = turned(place(n) + u[n]) - place(n);
  const CellResponse cell = cell_response(after, l, K);
  EXPECT_NEAR(cell.energy, before.energy, 1e-12 * before.energy);
  for (std::size_t n = 0; n < 8; ++n)
    EXPECT_LT(norm(cell.force[n] - turned(before.force[n])), 1e-12 * largest(before.force));
}

TEST(VolumetricCell, KeepsItsDigitsAtTinyDisplacements) {
  for (unsigned seed = 1; seed < 6; ++seed) {
    const CellCorners u = noise(1e-16 * l, seed);
    const CellResponse cell = cell_response(u, l, K);
    double theta = 0;  // the linear form: K_v l / 16 s s^T
    for (std::size_t n = 0; n < 8; ++n)
      for (std::size_t d = 0; d < 3; ++d) theta += u[n][d] * corner_sign(n, d) / (4 * l);
    for (std::size_t n = 0; n < 8; ++n)
      for (std::size_t d = 0; d < 3; ++d)
        EXPECT_NEAR(cell.force[n][d], -K * theta * l * l / 4 * corner_sign(n, d),
                    1e-14 * largest(cell.force));
  }
}

/// U = 9/2 K_v (stretch - 1)^2 for equal stretches along all axes.
TEST(VolumetricCell, HasTheEnergyOfTheMeanStretch) {
  for (const double stretch : {0.3, 0.7, 0.99, 1 + 1e-9, 1.01, 1.5, 3.0}) {
    const CellResponse cell = cell_response(stretched(stretch), l, K);
    const double energy = 4.5 * K * l * l * l * (stretch - 1) * (stretch - 1);
    // The displacements have the digits of stretch - 1.
    EXPECT_NEAR(cell.energy, energy, 1e-13 * energy) << stretch;
    EXPECT_NEAR(cell.volume_growth, stretch * stretch * stretch - 1, 1e-15 + 1e-13 * stretch);
  }
}

/// Below J = 1/64 the pressure goes on linearly, so that a cell that is inside out is pushed back.
TEST(VolumetricCell, PushesBackWhatIsInsideOut) {
  double before = volumetric_response(-0.9).pressure;
  for (double growth = -0.91; growth > -3; growth -= 0.01) {
    const VolumetricResponse now = volumetric_response(growth);
    EXPECT_LT(now.pressure, before);
    before = now.pressure;
  }
  const double at = least_volume - 1, h = 1e-9;
  const VolumetricResponse above = volumetric_response(at + h), below = volumetric_response(at - h);
  EXPECT_NEAR(above.pressure, -36, 1e-5);
  EXPECT_NEAR(below.pressure, -36, 1e-5);
  EXPECT_NEAR(above.stiffness, below.stiffness, 1e-3);
  EXPECT_NEAR(above.energy, below.energy, 1e-6);
}

/// The stiffness is the derivative of the pressure by J.
TEST(VolumetricCell, HasTheTangentOfItsPressure) {
  for (const double growth : {-0.99, -0.7, -0.2, -1e-3, 0.0, 1e-3, 0.4, 2.0}) {
    const double h = 1e-6;
    const double slope =
        (volumetric_response(growth + h).pressure - volumetric_response(growth - h).pressure) /
        (2 * h);
    EXPECT_NEAR(volumetric_response(growth).stiffness, slope,
                1e-7 * std::max(1.0, std::abs(slope)));
  }
}

}  // namespace volumetric_cell_test
