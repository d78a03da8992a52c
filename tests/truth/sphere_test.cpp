// The hollow sphere of section 3.2 of the paper, without failure. Its radial motion under a blast
// is compared with an independent one-dimensional solution (tests/data/README.md). The tolerance
// holds for stiffness by equation (15); the test also prints the error with bulk stiffness.
#include <support/scenes.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sstream>

namespace sphere_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

/// Columns of a CSV file by name.
struct Table {
  std::vector<std::string> names;
  std::vector<std::vector<double>> rows;

  explicit Table(const std::string& path) {
    std::ifstream file(path);
    std::string line, cell;
    std::getline(file, line);
    for (std::istringstream cells(line); std::getline(cells, cell, ',');) names.push_back(cell);
    while (std::getline(file, line)) {
      rows.emplace_back();
      for (std::istringstream cells(line); std::getline(cells, cell, ',');)
        rows.back().push_back(std::strtod(cell.c_str(), nullptr));
    }
  }
};

/// The true radial displacement, interpolated between the radii and times of the table.
class Truth {
 public:
  explicit Truth(const std::string& poisson)
      : table_(std::string(HYPERLATTICE_SOURCE) + "/tests/data/sphere_nu" + poisson + ".csv") {
    for (std::size_t c = 0; c < table_.names.size(); ++c)
      if (table_.names[c].starts_with("u_r@")) {
        radii_.push_back(std::stod(table_.names[c].substr(4)));
        columns_.push_back(c);
      }
  }
  double operator()(double radius, double time) const {
    std::size_t right = 1;
    while (right + 1 < radii_.size() && radii_[right] < radius) ++right;
    const double step = table_.rows[1][0] - table_.rows[0][0];
    const auto row = std::min(static_cast<std::size_t>(time / step), table_.rows.size() - 2);
    const double late = time / step - static_cast<double>(row);
    const auto at = [&](std::size_t r) {
      return (1 - late) * table_.rows[row][columns_[r]] + late * table_.rows[row + 1][columns_[r]];
    };
    const double outward = (radius - radii_[right - 1]) / (radii_[right] - radii_[right - 1]);
    return (1 - outward) * at(right - 1) + outward * at(right);
  }

 private:
  Table table_;
  std::vector<double> radii_;
  std::vector<std::size_t> columns_;
};

struct Shell {
  const char* name;
  double low, high;  ///< m
  std::vector<Particle> particles;
  double radius = 0, square_error = 0, square_truth = 0, peak = 0, true_peak = 0;

  double error() const { return std::sqrt(square_error / square_truth); }
  double peak_error() const { return std::abs(peak / true_peak - 1); }
};

struct Case {
  const char* poisson;
  int spacing_mm;
  double tolerance, peak_tolerance;  ///< relative: L2 norm over all times; first peak, up to 40 us
};

class Sphere : public testing::TestWithParam<Case> {
 protected:
  std::vector<Shell> run(const std::string& stiffness,
                         const std::string& boundary = "particles") const {
    const Case& c = GetParam();
    const double l = c.spacing_mm * 1e-3;
    const auto plan = plan_of(
        SceneBuilder{}
            .stage("lattices.cubic",
                   {{"spacing", std::to_string(c.spacing_mm) + " mm"},
                    {"boundary", boundary},
                    {"shape",
                     {{"hollow_sphere", {{"inner_radius", "20 mm"}, {"outer_radius", "50 mm"}}}}}})
            .material("materials.elastic", {{"young", "10 GPa"},
                                            {"density", 2500},
                                            {"membrane", "I-m"},
                                            {"poisson", std::stod(c.poisson)},
                                            {"stiffness", stiffness}})
            .load(
                "loads.blast",
                {{"on", "inner_surface"}, {"peak", "10 MPa"}, {"rise", "10 us"}, {"fall", "20 us"}})
            .solver("solvers.explicit", {{"end_time", "120 us"}})
            .text(),
        2);
    const Model& model = *plan->model;
    if (c.spacing_mm == 1 && boundary == "particles") {
      EXPECT_EQ(model.body.particles, 490432u);
      EXPECT_EQ(model.body.base_springs(), 4309140u);
    }
    std::vector<Shell> shells{{"inner", 0.020, 0.020 + l, {}},
                              {"middle", 0.035 - l / 2, 0.035 + l / 2, {}},
                              {"outer", 0.050 - l, 0.050, {}}};
    for (Particle p = 0; p < model.body.particles; ++p)
      for (Shell& shell : shells)
        if (const double r = norm(model.body.position(p)); r > shell.low && r < shell.high) {
          shell.particles.push_back(p);
          shell.radius += r;
        }
    for (Shell& shell : shells) shell.radius /= static_cast<double>(shell.particles.size());

    const Truth truth(c.poisson);
    Simulation simulation(model, 2);
    const auto steps = static_cast<int>(std::ceil(120e-6 / (0.9 * model.step_limit.time_step)));
    for (int n = 0; n < steps; ++n) {
      simulation.step(120e-6 / steps);
      const auto u = displacements(simulation);
      for (Shell& shell : shells) {
        double mean = 0;
        for (const Particle p : shell.particles) {
          const Vec3 x = model.body.position(p);
          mean += dot(x, {u[3 * p], u[3 * p + 1], u[3 * p + 2]}) / norm(x);
        }
        mean /= static_cast<double>(shell.particles.size());
        const double expected = truth(shell.radius, simulation.time());
        shell.square_error += (mean - expected) * (mean - expected);
        shell.square_truth += expected * expected;
        if (simulation.time() > 40e-6) continue;
        shell.peak = std::max(shell.peak, mean);
        shell.true_peak = std::max(shell.true_peak, expected);
      }
    }
    EXPECT_LT(std::abs(simulation.balance().relative_error()), 1e-3);
    for (const Shell& shell : shells)
      std::printf(
          "nu %s, spacing %d mm, %s, %s stiffness, %s shell: error %.1f %%, first peak %.1f %%\n",
          c.poisson, c.spacing_mm, boundary.c_str(), stiffness.c_str(), shell.name,
          100 * shell.error(), 100 * shell.peak_error());
    return shells;
  }
};
INSTANTIATE_TEST_SUITE_P(Cases, Sphere,
                         testing::Values(Case{"0.23", 2, 0.16, 0.06}, Case{"0.05", 2, 0.16, 0.06},
                                         Case{"0.23", 1, 0.10, 0.04}, Case{"0.05", 1, 0.10, 0.04}),
                         [](const auto& info) {
                           return "nu_0_" + std::string(info.param.poisson).substr(2) + "_" +
                                  std::to_string(info.param.spacing_mm) + "mm";
                         });

TEST_P(Sphere, FollowsTheRadialSolution) {
  const Case& c = GetParam();
  for (const Shell& shell : run("eq15")) {
    EXPECT_LT(shell.error(), c.tolerance) << shell.name;
    EXPECT_LT(shell.peak_error(), c.peak_tolerance) << shell.name;
  }
  for (const Shell& shell : run("bulk"))
    EXPECT_LT(shell.error(), 2 * c.tolerance)
        << shell.name;  // the softer surface delays the motion
}

// A body of cells needs no correction of its stiffness. Its error falls by more than half if the
// spacing is halved.
TEST_P(Sphere, FollowsItCloserWithCells) {
  for (const Shell& shell : run("bulk", "cells")) {
    EXPECT_LT(shell.error(), GetParam().spacing_mm == 2 ? 0.07 : 0.03) << shell.name;
    EXPECT_LT(shell.peak_error(), GetParam().spacing_mm == 2 ? 0.02 : 0.012) << shell.name;
  }
}

}  // namespace sphere_test
