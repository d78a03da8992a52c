// Actuated springs and faces against closed forms; expressions and other functions of time.
#include <support/cells.hpp>
#include <support/loaded_block.hpp>
#include <support/models.hpp>
#include <support/scenes.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace actuation_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

Stages actuation(const char* on, const Keys& keys) {
  return stage("loads.actuation", Keys{{"on", on}} + keys);
}

/// Displacements of the affine motion x -> F x; F is given by its columns.
std::vector<double> deformed(const Model& model, const Vec3 (&F)[3]) {
  std::vector<double> u;
  for (Particle p = 0; p < model.body.particles; ++p) {
    const Vec3 x = model.body.position(p), moved = x.x * F[0] + x.y * F[1] + x.z * F[2] - x;
    u.insert(u.end(), {moved.x, moved.y, moved.z});
  }
  return u;
}

TEST(Actuation, AStrainOfAllSpringsMakesTheBodyThatMuchLonger) {
  for (const char* boundary : {"particles", "cells"}) {
    const auto plan = plan_of(loaded_block(4, 3, 5, actuation("all", {{"strain", 0.02}}), 1e10,
                                           {{"poisson", 0.25}}, {{"boundary", boundary}}));
    const Model& model = *plan->model;
    Simulation simulation(model, 1);
    simulation.set_damping(0.8);
    for (int n = 0; n < 3000; ++n) simulation.step(0.5 * model.step_limit.time_step);
    const std::vector<double> u = displacements(simulation);
    for (Particle p = 0; p < model.body.particles; ++p) {
      const Vec3 rest =
          model.body.position(p) - model.body.position(0);  // damping may turn a free body
      const Vec3 apart = rest + Vec3{u[3 * p] - u[0], u[3 * p + 1] - u[1], u[3 * p + 2] - u[2]};
      EXPECT_NEAR(norm(apart), 1.02 * norm(rest), 1e-9 * 5e-3);
    }
  }
}

TEST(Actuation, ADirectionFollowsTheTurningBody) {  // the forces turn with the body
  const auto plan = plan_of(loaded_block(4, 3, 6, actuation("half", {{"force", 1}})));
  const Model& model = *plan->model;
  const Vec3 turn[3] = {{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}};
  Simulation straight(model, 1), turned(model, 1);
  turned.set_displacements(deformed(model, turn), {});
  straight.step(1e-9);
  turned.step(1e-9);
  std::vector<double> v, w;
  straight.velocities(v);
  turned.velocities(w);
  for (Particle p = 0; p < model.body.particles; ++p) {
    EXPECT_NEAR(w[3 * p + 1], v[3 * p], 1e-12 * largest(v));
    EXPECT_NEAR(w[3 * p], -v[3 * p + 1], 1e-12 * largest(v));
  }
}

TEST(Actuation, PressureFollowsFacesThatTurnAndStretch) {
  const auto plan = plan_of(loaded_block(4, 5, 6, actuation("z_max", {{"pressure", 3e3}}), 1e-3));
  const Model& model = *plan->model;
  const Vec3 F[3] = {{0, 1.2, 0}, {-0.9, 0.1, 0}, {0.3, 0, 1.1}};
  Simulation simulation(model, 2);
  simulation.set_displacements(deformed(model, F), {});
  const double step = 1e-9;
  simulation.step(step);
  const Vec3 force = (2 / step) * sums(model, simulation).momentum,
             expected = (-3e3 * 20e-6) * cross(F[0], F[1]);  // cof(F) A of the whole face
  EXPECT_LT(norm(force - expected), 1e-6 * norm(expected));
  EXPECT_NE(faults_of(box_lattice(4, 4, 1) + elastic() + actuation("z_max", {{"pressure", 1}}))
                .find("two particles thick"),
            std::string::npos);
}

TEST(Actuation, RefusesWhatItCannotDo) {
  const Stages body = box_lattice(3, 3, 3);
  const Stages breakable =
      elastic({{"poisson", 0.25}, {"failure", {{"type", "failures.elongation"}, {"limit", 1e-3}}}});
  EXPECT_NE(faults_of(body + breakable + actuation("all", {{"force", 1}})).find("do not break"),
            std::string::npos);
  EXPECT_NE(faults_of(body + elastic() +
                      stage("loads.actuation", {{"on", box({}, {1, 1, 1})}, {"force", 1}}))
                .find("no spring has both"),
            std::string::npos);
  EXPECT_NE(faults_of(body + elastic() + actuation("all", {{"force", 1}, {"strain", 1}}))
                .find("exactly one of"),
            std::string::npos);
  const std::string sentence =
      faults_of(body + elastic() +
                stage("loads.expression", {{"on", "all"}, {"force", 1}, {"expression", "sin(t"}}));
  EXPECT_NE(sentence.find("an expression of t, not"), std::string::npos) << sentence;
}

// The actuation strains the base springs by e, and the springs of the membrane not at all. A free
// body then grows by e K0 / K, with the bulk moduli K0 of the base springs and K of the lattice.
TEST(Actuation, AStrainOfAllSpringsGrowsAFreeBodyByTheRatioOfBulkModuli) {
  constexpr double e = 1e-8, l = 1e-3;
  for (const auto& [material, expected] : {std::pair{R"("poisson": 0.25)", 1.0},
                                           {R"("membrane": "I-m", "poisson": 0.1)", 0.7576},
                                           {R"("membrane": "I-m", "poisson": -0.1)", 0.30864},
                                           {R"("membrane": "III", "lambda": 2)", 0.44118}}) {
    const auto plan = plan_of(loaded_block(4, 3, 5, actuation("all", {{"strain", 1e-8}}), 1e10,
                                           material, {{"boundary", "cells"}}));
    const Model& model = *plan->model;
    const MaterialConstants& m = model.materials[0].constants;
    const double kb = m.cross_ratio[0], kg = m.cross_ratio[1], C3 = m.alpha_ratio + 3 * kb + 4 * kg,
                 C4 = kb + 8 * kg / 3;
    const double relaxation = model.degrees_of_freedom == 4 ? C4 / C3 : 0;
    const double unit = m.base_stiffness / (2 * l),
                 c11 = unit * (6 + kb + 8 * kg / 3 - relaxation * C4),
                 c12 = unit * (2 + 4 * kg / 3 - relaxation * C4);
    const double K0 = 5 * m.base_stiffness / (3 * l), K = (c11 + 2 * c12) / 3, grown = e * K0 / K;
    EXPECT_NEAR(grown / e, expected, 1e-4) << material;
    std::vector<double> heights;
    if (model.degrees_of_freedom == 4)
      heights.assign(model.body.particles, -relaxation * 3 * grown * l / 2);
    for (const auto& [strain, still] : {std::pair{grown, true}, {1.01 * grown, false}}) {
      std::vector<double> u;
      for (Particle p = 0; p < model.body.particles; ++p)
        for (const double x :
             {model.body.position(p).x, model.body.position(p).y, model.body.position(p).z})
          u.push_back(strain * x);
      double largest = 0;
      for (const Force& force : forces(model, u, heights))
        for (const double component : force)
          largest = std::max(largest, std::abs(component) / (m.base_stiffness * e * l));
      EXPECT_EQ(largest < 1e-6, still) << material << ' ' << largest;
    }
  }
}

TEST(Expression, IsTheFormThatItWrites) {
  const Stages sine = actuation(
      "half", {{"strain", 0.01}, {"form", "harmonic"}, {"frequency", 3e5}, {"phase", 0.5}});
  const Stages written =
      stage("loads.expression",
            {{"on", "half"}, {"strain", 0.01}, {"expression", "sin(2 * pi * 3e5 * t + 0.5) + 0"}});
  const auto a = plan_of(loaded_block(4, 3, 6, sine)), b = plan_of(loaded_block(4, 3, 6, written));
  Simulation one(*a->model, 1), other(*b->model, 1);
  for (int n = 0; n < 100; ++n) {
    one.step(2e-8);
    other.step(2e-8);
  }
  EXPECT_LT(distance(displacements(one), displacements(other)),
            1e-12 * largest(displacements(one)));
}

TEST(TimeFunctions, HaveTheShapesThatTheyName) {
  const auto pipeline = [](const std::string& form) {
    return box_lattice(2, 2, 2) + elastic() + actuation("all", Keys{{"force", 1}} + form);
  };
  const auto values = [&](const std::string& form,
                          const std::vector<std::pair<double, double>>& expected,
                          std::vector<double> corners) {
    const BuiltScene built = build(pipeline(form));
    for (const auto& [time, value] : expected)
      EXPECT_NEAR(built->loads[0].factor(time), value, 1e-12) << form << " at " << time;
    ASSERT_EQ(built->loads.corners.size(), corners.size()) << form;
    for (std::size_t n = 0; n < corners.size(); ++n)
      EXPECT_NEAR(built->loads.corners[n], corners[n], 1e-12);
  };
  values(R"("form": "constant", "start": 1, "rise": 2, "duration": 5)",
         {{0.5, 0}, {2, 0.5}, {4, 1}, {6, 1}, {6.1, 0}}, {1, 3, 6});
  values(R"("form": "triangle", "rise": 1, "fall": 3)",
         {{0, 0}, {0.5, 0.5}, {1, 1}, {2.5, 0.5}, {4, 0}, {9, 0}}, {1, 4});
  values(R"("form": "triangle", "rise": 1, "fall": 1, "period": 10, "pulses": 2)",
         {{1, 1}, {5, 0}, {10.5, 0.5}, {11, 1}, {21, 0}}, {1, 2, 10, 11, 12});
  values(R"("form": "half_sine", "duration": 2, "start": 1)",
         {{1, 0}, {2, 1}, {1.5, std::sqrt(0.5)}, {3.5, 0}}, {1, 3});
  values(R"("form": "harmonic", "frequency": 0.25, "phase": 1.5707963267948966)",
         {{0, 1}, {1, 0}, {2, -1}, {4, 1}}, {});
  values(R"("form": "table", "times": [1, 2, 4], "values": [3, -1, 1])",
         {{0.5, 0}, {1, 3}, {1.5, 1}, {3, 0}, {4, 1}, {5, 0}}, {1, 2, 4});
  for (const auto& [form, sentence] :
       {std::pair{R"("form": "triangle", "rise": 1)", "it is needed with the form triangle"},
        {R"("form": "harmonic", "frequency": 1, "fall": 1)", "it left out with the form harmonic"},
        {R"("form": "table", "times": [2, 1], "values": [0, 0])", "times that ascend"},
        {R"("form": "table", "times": [1, 2], "values": [0])", "as many as there are times"},
        {R"("form": "triangle", "rise": 1, "fall": 1, "pulses": 3)", "period"}})
    EXPECT_NE(faults_of(pipeline(form)).find(sentence), std::string::npos) << form;
}

}  // namespace actuation_test
