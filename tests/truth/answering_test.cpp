// Loads that answer to the motion: their momentum and energy against closed forms, and their effect
// on the critical time step.
#include <support/books.hpp>
#include <support/cells.hpp>
#include <support/models.hpp>
#include <support/scenes.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace {
using namespace hyperlattice;
using namespace hyperlattice::test;

/// A block of 1 mm cells, soft as rubber or stiff as stone, with more stages.
std::string scene(int nx, int ny, int nz, const std::string& stages, double young = 1e10,
                  const std::string& material = R"("poisson": 0.25)",
                  const std::string& lattice = R"("boundary": "particles")") {
  const auto mm = [](int n) { return std::to_string(n) + "e-3"; };
  return R"({ "format": "hyperlattice/1", "regions": { "half": { "half_space": { "point": [0, 0, )" +
         mm(nz / 2) + R"(], "normal": [0, 0, 1] } } },
    "pipeline": [ { "type": "lattices.cubic", "spacing": 1e-3, )" +
         lattice + R"(, "shape": { "box": { "low": [0, 0, 0], "high": [)" + mm(nx) + ", " + mm(ny) +
         ", " + mm(nz) + R"(] } } }, { "type": "materials.elastic", "density": 2500, "young": )" +
         std::to_string(young) + ", " + material + " }, " + stages +
         R"(, { "type": "solvers.explicit", "end_time": 1e-6 } ] })";
}
const char* const membrane = R"("membrane": "I-m", "poisson": 0.1)";

struct Sums {
  Vec3 momentum, spin;  ///< angular momentum about the origin
  double size = 0;      ///< sum of m |v|
};
Sums sums(const Model& model, const Simulation& simulation) {
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

/// Displacements of the affine motion x -> F x; F is given by its columns.
std::vector<double> deformed(const Model& model, const Vec3 (&F)[3]) {
  std::vector<double> u;
  for (Particle p = 0; p < model.body.particles; ++p) {
    const Vec3 x = model.body.position(p), moved = x.x * F[0] + x.y * F[1] + x.z * F[2] - x;
    u.insert(u.end(), {moved.x, moved.y, moved.z});
  }
  return u;
}

struct Case {
  const char* name;
  const char* loads;
};
const Case inner[] = {
    {"force",
     R"({ "type": "loads.actuation", "on": "half", "force": 20, "form": "triangle", "rise": 1e-6, "fall": 1e-6 })"},
    {"strain",
     R"({ "type": "loads.actuation", "on": "half", "strain": -0.02, "form": "half_sine", "duration": 2e-6 })"},
    {"expression",
     R"({ "type": "loads.expression", "on": "half", "force": 20, "expression": "1 * sin(2 * pi * 4e5 * t) + 0" })"},
};
const Case outer[] = {
    {"pressure", R"({ "type": "loads.actuation", "on": "z_max", "pressure": 1e8, "rise": 1e-6 })"},
    {"drag",
     R"({ "type": "loads.drag", "density": 1000, "stream": [30, 0, 10], "top_speed": 100, "linear_along": 1e5 })"},
    {"floor",
     R"({ "type": "loads.floor", "friction": 0.5, "point": [0, 0, 0.0001] }, { "type": "loads.start_velocity", "linear": [5, 0, -10] })"},
    {"slow_floor",
     R"({ "type": "loads.floor", "friction": 0.5, "friction_back": 0.1, "forward": [1, 1, 0], "damping": 0 },
                      { "type": "loads.gravity", "acceleration": [1e6, 0, -4e6] })"},
};

class Inner : public testing::TestWithParam<Case> {};
class Answering : public testing::TestWithParam<Case> {};
const auto name_of = [](const auto& info) { return std::string(info.param.name); };
INSTANTIATE_TEST_SUITE_P(Inner, Inner, testing::ValuesIn(inner), name_of);
INSTANTIATE_TEST_SUITE_P(Inner, Answering, testing::ValuesIn(inner), name_of);
INSTANTIATE_TEST_SUITE_P(Outer, Answering, testing::ValuesIn(outer), name_of);

TEST_P(Inner, KeepsMomentumAndSpin) {
  for (const char* boundary : {R"("boundary": "particles")", R"("boundary": "cells")"}) {
    const auto plan = plan_of(scene(5, 4, 8, GetParam().loads, 1e10, membrane, boundary));
    const Model& model = *plan->model;
    Simulation simulation(model, 2);
    for (int n = 0; n < 300; ++n) simulation.step(0.5 * model.critical_time_step);
    const Sums now = sums(model, simulation);
    EXPECT_GT(now.size, 0);
    EXPECT_LT(norm(now.momentum), 1e-13 * now.size) << boundary;
    EXPECT_LT(norm(now.spin), 1e-13 * now.size * 8e-3) << boundary;
  }
}

TEST_P(Answering, TheBalanceClosesToTheSquareOfTheStep) {
  for (const char* material : {R"("poisson": 0.25)", membrane}) {
    const auto plan = plan_of(scene(5, 4, 6, GetParam().loads, 1e10, material));
    const Books at_two_fifths = keep_books(*plan->model, 0.4),
                at_a_fifth = keep_books(*plan->model, 0.2);
    for (const Books* books : {&at_two_fifths, &at_a_fifth}) EXPECT_NE(books->last.injected, 0);
    const double coarse = at_two_fifths.largest_error, fine = at_a_fifth.largest_error;
    std::printf(
        "%s: largest relative error %.2e at 0.4 of the critical step, %.2e at 0.2: ratio %.2f\n",
        GetParam().name, coarse, fine, coarse / fine);
    EXPECT_LT(coarse, 5e-3);
    EXPECT_GT(coarse / fine, 3) << "half the step, a quarter of the error";
  }
}

TEST_P(Answering, TheSameBitsForAnyNumberOfThreads) {
  const auto plan = plan_of(scene(5, 4, 9, GetParam().loads, 1e10, membrane));
  std::vector<std::uint64_t> hashes;
  std::vector<double> works;
  for (const int threads : {1, 2, 3, 7}) {
    Simulation simulation(*plan->model, threads);
    for (int n = 0; n < 60; ++n) simulation.step(0.5 * plan->model->critical_time_step);
    hashes.push_back(simulation.hash());
    works.push_back(simulation.balance().injected);
  }
  for (std::size_t n = 1; n < hashes.size(); ++n) {
    EXPECT_EQ(hashes[n], hashes[0]);
    EXPECT_EQ(works[n], works[0]);
  }
}

TEST(Actuation, AStrainOfAllSpringsMakesTheBodyThatMuchLonger) {
  for (const char* boundary : {R"("boundary": "particles")", R"("boundary": "cells")"}) {
    const auto plan =
        plan_of(scene(4, 3, 5, R"({ "type": "loads.actuation", "on": "all", "strain": 0.02 })",
                      1e10, R"("poisson": 0.25)", boundary));
    const Model& model = *plan->model;
    Simulation simulation(model, 1);
    simulation.set_damping(0.8);
    for (int n = 0; n < 3000; ++n) simulation.step(0.5 * model.critical_time_step);
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
  const auto plan =
      plan_of(scene(4, 3, 6, R"({ "type": "loads.actuation", "on": "half", "force": 1 })"));
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
  const auto plan = plan_of(
      scene(4, 5, 6, R"({ "type": "loads.actuation", "on": "z_max", "pressure": 3e3 })", 1e-3));
  const Model& model = *plan->model;
  const Vec3 F[3] = {{0, 1.2, 0}, {-0.9, 0.1, 0}, {0.3, 0, 1.1}};
  Simulation simulation(model, 2);
  simulation.set_displacements(deformed(model, F), {});
  const double step = 1e-9;
  simulation.step(step);
  const Vec3 force = (2 / step) * sums(model, simulation).momentum,
             expected = (-3e3 * 20e-6) * cross(F[0], F[1]);  // cof(F) A of the whole face
  EXPECT_LT(norm(force - expected), 1e-6 * norm(expected));
  EXPECT_NE(faults_of(box_lattice(4, 4, 1) + "," + elastic() +
                      R"(, { "type": "loads.actuation", "on": "z_max", "pressure": 1 })")
                .find("two particles thick"),
            std::string::npos);
}

TEST(Actuation, RefusesWhatItCannotDo) {
  const std::string box = box_lattice(3, 3, 3) + ",";
  const std::string breakable =
      elastic(R"("poisson": 0.25, "failure": { "type": "failures.elongation", "limit": 1e-3 })");
  EXPECT_NE(
      faults_of(box + breakable + R"(, { "type": "loads.actuation", "on": "all", "force": 1 })")
          .find("do not break"),
      std::string::npos);
  EXPECT_NE(
      faults_of(
          box + elastic() +
          R"(, { "type": "loads.actuation", "on": { "box": { "low": [0, 0, 0], "high": [1, 1, 1] } }, "force": 1 })")
          .find("no spring has both"),
      std::string::npos);
  EXPECT_NE(faults_of(box + elastic() +
                      R"(, { "type": "loads.actuation", "on": "all", "force": 1, "strain": 1 })")
                .find("exactly one of"),
            std::string::npos);
  const std::string sentence = faults_of(
      box + elastic() +
      R"(, { "type": "loads.expression", "on": "all", "force": 1, "expression": "sin(t" })");
  EXPECT_NE(sentence.find("an expression of t, not"), std::string::npos) << sentence;
}

TEST(Expression, IsTheFormThatItWrites) {
  const char* sine =
      R"({ "type": "loads.actuation", "on": "half", "strain": 0.01, "form": "harmonic", "frequency": 3e5, "phase": 0.5 })";
  const char* written =
      R"({ "type": "loads.expression", "on": "half", "strain": 0.01, "expression": "sin(2 * pi * 3e5 * t + 0.5) + 0"
})";
  const auto a = plan_of(scene(4, 3, 6, sine)), b = plan_of(scene(4, 3, 6, written));
  Simulation one(*a->model, 1), other(*b->model, 1);
  for (int n = 0; n < 100; ++n) {
    one.step(2e-8);
    other.step(2e-8);
  }
  EXPECT_LT(distance(displacements(one), displacements(other)),
            1e-12 * largest(displacements(one)));
}

// The block is soft and gravity is strong, so that the block slides far in few steps.
constexpr double heavy = 500;  // m/s2
std::string sliding(const std::string& floor, Vec3 gravity, Vec3 start) {
  const auto text = [](Vec3 v) {
    return "[" + std::to_string(v.x) + ", " + std::to_string(v.y) + ", " + std::to_string(v.z) +
           "]";
  };
  return scene(5, 5, 3,
               R"({ "type": "loads.floor", )" + floor +
                   R"( }, { "type": "loads.gravity", "acceleration": )" + text(gravity) +
                   R"( }, { "type": "loads.start_velocity", "linear": )" + text(start) + " }",
               1e7);
}
/// The mean position and velocity of the body at that time.
std::pair<Vec3, Vec3> mean_motion(const Plan& plan, double time) {
  const Model& model = *plan.model;
  Simulation simulation(model, 2);
  while (simulation.time() < time) simulation.step(0.5 * model.critical_time_step);
  std::vector<double> u, v;
  simulation.displacements(u);
  simulation.velocities(v);
  Vec3 place, speed;
  const double share = 1 / static_cast<double>(model.body.particles);
  for (Particle p = 0; p < model.body.particles; ++p) {
    place = place + share * Vec3{u[3 * p], u[3 * p + 1], u[3 * p + 2]};
    speed = speed + share * Vec3{v[3 * p], v[3 * p + 1], v[3 * p + 2]};
  }
  return {place, speed};
}

TEST(Floor, CarriesTheWeightAndStopsASlidingBlock) {
  const auto plan = plan_of(sliding(R"("friction": 0.4)", {0, 0, -heavy}, {2, 0, 0}));
  const auto [place, speed] = mean_motion(*plan, 20e-3);  // the block stops after 10 ms
  EXPECT_NEAR(place.x, 4 / (2 * 0.4 * heavy), 0.03 * place.x);
  EXPECT_LT(std::abs(speed.x), 0.01);
  // The floor yields by m g / c under each particle, and the body by its own weight.
  EXPECT_NEAR(place.z, 0, 0.3e-3);
}

TEST(Floor, HasAnotherFrictionBackwards) {
  const char* floor = R"("friction": 0.2, "friction_back": 0.6, "forward": [1, 0, 0])";
  const double forward =
      mean_motion(*plan_of(sliding(floor, {0, 0, -heavy}, {1, 0, 0})), 15e-3).first.x;
  const double back =
      -mean_motion(*plan_of(sliding(floor, {0, 0, -heavy}, {-1, 0, 0})), 15e-3).first.x;
  EXPECT_NEAR(forward, 1 / (2 * 0.2 * heavy), 0.04 * forward);
  EXPECT_NEAR(back, 1 / (2 * 0.6 * heavy), 0.06 * back);
}

TEST(Floor, AnInclineHoldsABlockUpToItsFriction) {
  for (const double slope : {0.2, 0.4}) {  // tangent of the slope; the friction is 0.3
    const double down = heavy / std::hypot(1, slope);
    const auto [place, speed] =
        mean_motion(*plan_of(sliding(R"("friction": 0.3)", {slope * down, 0, -down}, {})), 10e-3);
    if (slope < 0.3)
      EXPECT_LT(speed.x, 0.01);
    else
      EXPECT_NEAR(speed.x, (slope - 0.3) * down * 10e-3, 0.03 * speed.x);
  }
}

TEST(Drag, LinearSlowsExponentiallyAndQuadraticHyperbolically) {
  // A cube of edge h moves along x. Its front and back have the drag across, two of its sides the
  // drag along.
  const double h = 4e-3, mass = 2500 * h * h * h;
  const auto drag = [](const std::string& across, const std::string& along, const char* speed) {
    std::string loads =
        R"({ "type": "loads.start_velocity", "linear": [)" + std::string(speed) + ", 0, 0] }";
    for (const char* face : {"x_min", "x_max", "y_min", "y_max"})
      loads += R"(, { "type": "loads.drag", "on": ")" + std::string(face) + "\", " +
               (face[0] == 'x' ? across : along) + " }";
    return plan_of(scene(4, 4, 4, loads));
  };
  const double linear = (2 * 3e3 + 2 * 1e3) * h * h / mass;
  const auto first = drag(R"("linear_across": 3e3)", R"("linear_along": 1e3)", "1");
  EXPECT_NEAR(mean_motion(*first, 1e-3).second.x, std::exp(-linear * 1e-3), 0.01);
  const double quadratic = 0.5 * 1000 * (2 * 1.5 + 2 * 0.5) * h * h / mass;
  const auto second = drag(R"("density": 1000, "across": 1.5, "top_speed": 20)",
                           R"("density": 1000, "along": 0.5, "top_speed": 20)", "10");
  EXPECT_NEAR(mean_motion(*second, 1e-3).second.x, 10 / (1 + 10 * quadratic * 1e-3), 0.05);
}

/// Does the body stay bounded over 3000 steps of this fraction of the critical time step?
bool is_bounded(const Model& model, double fraction) {
  Simulation simulation(model, 1);
  simulation.set_velocities(noise(3 * model.body.particles, 1e-6, 7), {});
  for (int n = 0; n < 3000; ++n) simulation.step(fraction * model.critical_time_step);
  return largest(displacements(simulation)) < 1e-3;
}

TEST(CriticalStep, KnowsHowStiffAContactIsAndHowViscous) {
  const auto free =
      plan_of(scene(4, 4, 4, R"({ "type": "loads.gravity", "acceleration": [0, 0, 0] })"));
  const double mass = 2500e-9, alone = free->model->critical_time_step;
  // The contact is far stiffer than the body, so that a particle oscillates on its contact alone.
  // The floor stands above the lowest particles, so that all of z_min always touches it.
  const auto stiff = plan_of(scene(
      4, 4, 4,
      R"({ "type": "loads.floor", "on": "z_min", "stiffness": 1e9, "damping": 0, "point": [0, 0, 1e-5] })"));
  EXPECT_NEAR(stiff->model->critical_time_step, 2 / std::sqrt(4 / (alone * alone) + 1e9 / mass),
              1e-12 * alone);
  EXPECT_NE(stiff->model->critical_because.find("loads.floor (/pipeline/2)"), std::string::npos);
  const auto viscous = plan_of(
      scene(4, 4, 4, R"({ "type": "loads.drag", "linear_across": 1e9, "linear_along": 1e9 })"));
  const double rate = 1e9 * std::sqrt(3.0) * 1e-6 / mass;  // rate of a corner particle
  EXPECT_NEAR(viscous->model->critical_time_step,
              2 / (rate / 2 + std::sqrt(rate * rate / 4 + 4 / (alone * alone))), 1e-9 * alone);
  EXPECT_TRUE(is_bounded(*viscous->model, 0.99));
  EXPECT_FALSE(is_bounded(*viscous->model, 1.1));
}

TEST(TimeFunctions, HaveTheShapesThatTheyName) {
  const auto load = [](const std::string& form) {
    return build(box_lattice(2, 2, 2) + "," + elastic() +
                 R"(, { "type": "loads.actuation", "on": "all", "force": 1, )" + form + " }");
  };
  const auto values = [&](const std::string& form,
                          const std::vector<std::pair<double, double>>& expected,
                          std::vector<double> corners) {
    const BuiltScene built = load(form);
    for (const auto& [time, value] : expected)
      EXPECT_NEAR(built->loads[0].factor(time), value, 1e-12) << form << " at " << time;
    ASSERT_EQ(built->corners.size(), corners.size()) << form;
    for (std::size_t n = 0; n < corners.size(); ++n)
      EXPECT_NEAR(built->corners[n], corners[n], 1e-12);
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
    EXPECT_NE(faults_of(box_lattice(2, 2, 2) + "," + elastic() +
                        R"(, { "type": "loads.actuation", "on": "all", "force": 1, )" + form + " }")
                  .find(sentence),
              std::string::npos)
        << form;
}

TEST(AnsweringLoads, StaticSolversRefuseSuchLoads) {
  std::string text = scene(3, 3, 3, R"({ "type": "loads.floor" })");
  text.replace(text.find("solvers.explicit"), 16, "solvers.static");
  try {
    plan_of(text);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("do not answer to the motion"), std::string::npos)
        << error.what();
  }
}

// The actuation strains the base springs by e, and the springs of the membrane not at all. A free
// body then grows by e K0 / K, with the bulk moduli K0 of the base springs and K of the lattice.
TEST(Actuation, AStrainOfAllSpringsGrowsAFreeBodyByTheRatioOfBulkModuli) {
  constexpr double e = 1e-8, l = 1e-3;
  for (const auto& [material, expected] : {std::pair{R"("poisson": 0.25)", 1.0},
                                           {R"("membrane": "I-m", "poisson": 0.1)", 0.7576},
                                           {R"("membrane": "I-m", "poisson": -0.1)", 0.30864},
                                           {R"("membrane": "III", "lambda": 2)", 0.44118}}) {
    const auto plan =
        plan_of(scene(4, 3, 5, R"({ "type": "loads.actuation", "on": "all", "strain": 1e-8 })",
                      1e10, material, R"("boundary": "cells")"));
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

}  // namespace
