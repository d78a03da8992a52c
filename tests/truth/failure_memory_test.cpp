// Several failure criteria on one material, and criteria that keep numbers for each spring: against
// closed forms, with restarts, threads, lists of springs and two materials.
#include <contract/contract.hpp>
#include <contract/scenes.hpp>
#include <support/components.hpp>
#include <support/lists.hpp>
#include <support/models.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <numbers>
#include <set>
#include <tuple>

namespace failure_memory_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

/// The criterion of these tests: a damage of K = 1 us * 0.004^2 breaks a spring.
constexpr double threshold = 0.002, impulse = 1.6e-11;
const std::string tuler_butcher =
    R"({ "type": "failures.tuler_butcher", "threshold": 0.002, "impulse": "16e-12 s" })";

std::string breakable(const std::string& failure) {
  return R"("poisson": 0.25, "failure": )" + failure;
}
std::string both(const std::string& one, const std::string& other) {
  return "[" + one + ", " + other + "]";
}
std::string limit(const std::string& type, const std::string& value) {
  return R"({ "type": "failures.)" + type + R"(", "limit": ")" + value + R"(" })";
}

/// The same scene with the folder of the test's own plugins.
std::string with_plugins(const std::string& scene) {
  return SceneBuilder(scene).key("plugins", {HYPERLATTICE_BUILD "/tests/truth_plugins"}).text();
}

/// Displacements x -> x + strain x + shear y along x.
std::vector<double> strained(const Model& model, double strain, double shear = 0) {
  std::vector<double> u;
  for (Particle p = 0; p < model.body.particles; ++p) {
    const Vec3 x = model.body.position(p);
    u.insert(u.end(), {strain * x.x + shear * x.y, 0, 0});
  }
  return u;
}

/// Sets the displacements and velocities of a body, and takes a step.
void lead(Simulation& simulation, const std::vector<double>& u, double step) {
  simulation.set_displacements(u, {});
  simulation.set_velocities(std::vector<double>(u.size(), 0.0), {});
  simulation.step(step);
}

using Spring = std::pair<Particle, Particle>;
/// The step in which each spring broke.
std::map<Spring, std::uint64_t> steps_of(const Simulation& simulation) {
  std::map<Spring, std::uint64_t> steps;
  for (const Breakage& breakage : simulation.breakages()) {
    const bool is_new = steps.emplace(std::minmax(breakage.a, breakage.b), breakage.step).second;
    EXPECT_TRUE(is_new) << breakage.a << " " << breakage.b << " broke twice";
  }
  return steps;
}

/// Calls visit(spring, strain) for all springs of a body with these displacements.
void for_strains(const Model& model, const std::vector<double>& u,
                 const std::function<void(Spring, double)>& visit) {
  const auto place = [&](Particle p) {
    return model.body.position(p) + Vec3{u[3 * p], u[3 * p + 1], u[3 * p + 2]};
  };
  model.body.for_springs([&](Particle a, Particle b, std::uint32_t) {
    const double rest = norm(model.body.position(b) - model.body.position(a)),
                 now = norm(place(b) - place(a));
    visit(std::minmax(a, b), now / rest - 1);
  });
}

/// The steps in which springs break that are held at a constant strain from time 0 on.
void compare_held(const Plan& plan, double strain, double shear, double step, int steps) {
  const Model& model = *plan.model;
  const std::vector<double> u = strained(model, strain, shear);
  std::map<Spring, std::uint64_t> first;
  for (const int threads : {1, 2, 3}) {
    Simulation simulation(model, threads);
    for (int n = 0; n < steps; ++n) lead(simulation, u, step);
    const std::map<Spring, std::uint64_t> found = steps_of(simulation);
    std::size_t expected = 0;
    for_strains(model, u, [&](Spring spring, double e) {
      // Steps 0 to n - 1 have taken n - 1 step lengths: the first review sees no time.
      const double time = impulse / std::pow(std::max(e - threshold, 0.0), 2);
      if (time > (steps - 1) * step * (1 + 1e-9)) {
        EXPECT_EQ(found.count(spring), 0u) << e;
        return;
      }
      ++expected;
      ASSERT_EQ(found.count(spring), 1u) << e;
      const double broke = static_cast<double>(found.at(spring)) * step;
      EXPECT_GE(broke, time * (1 - 1e-9)) << e;
      EXPECT_LT(broke, time * (1 + 1e-9) + step) << e;
    });
    EXPECT_EQ(found.size(), expected) << threads << " threads";
    EXPECT_GT(expected, 50u);
    if (threads == 1) first = found;
    EXPECT_EQ(found, first) << threads << " threads";
  }
  std::printf("%zu springs broke, of different strains\n", first.size());
}

TEST(FailureMemory, AConstantStrainBreaksAfterItsTime) {
  const auto plan = plan_of(block(5, 4, 6, breakable(tuler_butcher)));
  const double step = 0.01 * plan->model->step_limit.time_step;
  // Springs along x have the strain 0.01 and break after 0.25 us; diagonal springs have 0.005 and
  // break after 1.8 us.
  compare_held(*plan, 0.01, 0, step, static_cast<int>(3e-6 / step));
  compare_held(*plan, 0.01, 0.004, 3 * step, static_cast<int>(1e-6 / step));
}

TEST(FailureMemory, ListsOfSpringsKeepItToo) {
  const ListFiles files(5, 4, 6);
  const auto list =
      plan_of(listed_scene(files.lattice(), R"("membrane": "none", "failure": )" + tuler_butcher));
  const double step = 0.02 * list->model->step_limit.time_step;
  compare_held(*list, 0.01, 0.004, step, static_cast<int>(2e-6 / step));
  const auto random = plan_of(
      listed_scene(random_lattice(6, 6, 6), R"("membrane": "none", "failure": )" + tuler_butcher));
  compare_held(*random, 0.01, 0.004, step, static_cast<int>(2e-6 / step));
}

/// The damage of a spring after a history of strain, e(t) for 0 <= t <= time, in equal steps.
double damage_after(const Material::Criterion& criterion, const SpringFacts& spring,
                    const std::function<double(double)>& strain, double time, int steps) {
  double damage = 0;
  const Particle a = 0, b = 1;
  for (int n = 0; n <= steps; ++n) {
    const double now = n * time / steps, elongation = strain(now) * spring.rest_length;
    const SpringBatch batch{now,     spring, {&elongation, 1}, {&a, 1},
                            {&b, 1}, {},     &damage,          n == 0 ? 0 : time / steps};
    std::uint8_t broken = 0;
    Complaint why{};
    EXPECT_TRUE(criterion.stage->functions<FailureFunctions>().review(criterion.component.get(),
                                                                      batch, &broken, why));
  }
  return damage;
}

TEST(FailureMemory, TheIntegralIsOfFirstOrderAndOfSecondForAPulse) {
  for (const double exponent : {1.0, 2.0, 3.5}) {
    const auto plan = plan_of(block(
        2, 1, 1,
        breakable(
            R"({ "type": "failures.tuler_butcher", "threshold": 0.002, "impulse": 1, "exponent": )" +
            std::to_string(exponent) + " }")));
    const Material::Criterion& criterion = plan->model->materials.front().failures.front();
    EXPECT_EQ(criterion.start.front(), 0);
    const SpringFacts spring{1e-3, 1e7, 1e-3, 0, 0};
    const double time = 2e-6, high = 0.01;
    // A ramp: high^n T / (n + 1), and half a step's share of the highest value too much.
    const double ramp = std::pow(high, exponent) * time / (exponent + 1);
    // A pulse of half a sine: high^n T times the mean of sin^n.
    const double pulse = std::pow(high, exponent) * time * std::tgamma((exponent + 1) / 2) /
                         (std::sqrt(std::numbers::pi) * std::tgamma(exponent / 2 + 1));
    double before_ramp = 0, before_pulse = 0;
    for (const int steps : {50, 100, 200}) {
      const double of_ramp =
                       damage_after(
                           criterion, spring, [&](double t) { return threshold + high * t / time; },
                           time, steps) /
                           ramp -
                       1,
                   of_pulse = damage_after(
                                  criterion, spring,
                                  [&](double t) {
                                    return threshold + high * std::sin(std::numbers::pi * t / time);
                                  },
                                  time, steps) /
                                  pulse -
                              1;
      EXPECT_NEAR(of_ramp, (exponent + 1) / (2 * steps), 0.02 * (exponent + 1) / steps);
      if (before_ramp != 0) {
        EXPECT_NEAR(before_ramp / of_ramp, 2, 0.1) << exponent;
        if (std::abs(before_pulse) > 1e-10) {
          EXPECT_GT(before_pulse / of_pulse, 3.9) << exponent;
        }
      }
      before_ramp = of_ramp;
      before_pulse = of_pulse;
    }
  }
}

TEST(FailureMemory, TimeThatIsHeldDoesNoDamage) {
  const auto plan = plan_of(block(3, 3, 3, breakable(tuler_butcher)));
  const Model& model = *plan->model;
  const std::vector<double> u = strained(model, 0.01);  // breaks after 0.25 us
  const double step = 0.1 * model.step_limit.time_step;
  const auto needed = static_cast<std::uint64_t>(std::ceil(0.25e-6 / step));
  Simulation simulation(model, 2);
  simulation.hold_time(0);
  for (int n = 0; n < 200; ++n) lead(simulation, u, step);
  simulation.release_time();
  EXPECT_TRUE(simulation.breakages().empty());
  while (simulation.breakages().empty() && simulation.steps() < 1000) lead(simulation, u, step);
  EXPECT_EQ(simulation.breakages().front().step, 200 + needed);
  EXPECT_NEAR(simulation.breakages().front().time, 0.25e-6, step);
}

TEST(FailureCriteria, TheFirstThatIsMetBreaksASpring) {
  // Springs along x are strained by 0.95 % and grow by 9.5 um, some diagonals by 0.68 %, 9.58 um.
  const std::vector<std::string> criteria{limit("strain", "0.8 %"), limit("elongation", "9.54 um")};
  std::map<Spring, std::uint64_t> found[4];
  int n = 0;
  for (const std::string& failure :
       {both(criteria[0], criteria[1]), both(criteria[1], criteria[0]), criteria[0], criteria[1]}) {
    const auto plan = plan_of(block(5, 4, 6, breakable(failure)));
    EXPECT_EQ(plan->model->materials.front().failures.size(), n < 2 ? 2u : 1u);
    Simulation simulation(*plan->model, 1 + n % 3);
    lead(simulation, strained(*plan->model, 0.0095, 0.004),
         1e-3 * plan->model->step_limit.time_step);
    found[n++] = steps_of(simulation);
  }
  EXPECT_EQ(found[0], found[1]);
  std::map<Spring, std::uint64_t> either = found[2];
  either.insert(found[3].begin(), found[3].end());
  EXPECT_EQ(found[0], either);
  EXPECT_GT(either.size(), found[2].size());
  EXPECT_GT(either.size(), found[3].size());
}

TEST(FailureCriteria, TheAlarmIsTheSmallestOfAll) {
  const auto plan =
      plan_of(block(3, 3, 3, breakable(both(limit("strain", "0.8 %"), tuler_butcher))));
  const Model& model = *plan->model;
  for (const NeighbourGeometry& to : model.springs.neighbours)
    EXPECT_NEAR(model.springs.spring(0, 0, to.site.spring_class).alarm, threshold * to.rest_length,
                1e-15 * to.rest_length);
}

TEST(FailureCriteria, EachIsAskedAboveItsOwnAlarmOnly) {  // or else the fatigue throws
  const std::string fatigue =
      R"({ "type": "failures.fatigue", "limit": 0.006, "cycles": 1, "strict": true })";
  const std::string weibull =
      R"({ "type": "failures.weibull", "scale": 0.009, "modulus": 3, "least": 0.01 })";
  const ListFiles files(5, 4, 6);
  for (const std::string& failure : {both(fatigue, weibull), both(weibull, fatigue)})
    for (const std::string& scene :
         {block(5, 4, 6, breakable(failure)),
          listed_scene(files.lattice(), R"("membrane": "none", "failure": )" + failure)}) {
      const auto plan = plan_of(with_plugins(scene));
      const Model& model = *plan->model;
      for (const double strain : {0.0059, 0.01}) {
        Simulation simulation(model, 2);
        const std::vector<double> u = strained(model, strain);
        lead(simulation, u, 1e-3 * model.step_limit.time_step);
        const std::map<Spring, std::uint64_t> found = steps_of(simulation);
        std::size_t above = 0, between = 0;
        for_strains(model, u, [&](Spring spring, double e) {
          if (e > 0.006) {
            EXPECT_EQ(found.count(spring), 1u) << e;
            ++above;
          } else {
            between += found.count(spring);
          }
        });
        EXPECT_EQ(above > 0, strain > 0.006);
        EXPECT_GT(between, 0u);
      }
    }
}

TEST(FailureCriteria, MemoryAndLimitTogetherInAnyOrder) {
  // The strain of 0.01 breaks at once by the limit, 0.005 after 1.8 us by its damage.
  const std::string of_strain = limit("strain", "0.8 %");
  std::map<Spring, std::uint64_t> found[3];
  int n = 0;
  for (const std::string& failure :
       {both(of_strain, tuler_butcher), both(tuler_butcher, of_strain), tuler_butcher}) {
    const auto plan = plan_of(block(5, 4, 6, breakable(failure)));
    Simulation simulation(*plan->model, 3);
    const double step = 0.05 * plan->model->step_limit.time_step;
    while (simulation.time() < 3e-6) lead(simulation, strained(*plan->model, 0.01), step);
    found[n++] = steps_of(simulation);
  }
  EXPECT_EQ(found[0], found[1]);
  ASSERT_EQ(found[0].size(), found[2].size());
  std::size_t at_once = 0;
  for (const auto& [spring, step] : found[0]) {
    if (step == 0)
      ++at_once;
    else
      EXPECT_EQ(step, found[2].at(spring));
  }
  EXPECT_GT(at_once, 0u);
  EXPECT_LT(at_once, found[0].size());
}

TEST(FailureCriteria, ASpringBetweenMaterialsKeepsAMemoryForEach) {
  // The second material holds for half the time, the third for ever.
  const std::string more =
      R"({ "type": "materials.elastic", "region": { "box": { "low": [2e-3, 0, 0], "high": [4e-3, 1, 1] } },
           "young": 1e10, "density": 2500, "poisson": 0.25,
           "failure": { "type": "failures.tuler_butcher", "threshold": 0.002, "impulse": "8e-12 s" } },
         { "type": "materials.elastic", "region": { "box": { "low": [4e-3, 0, 0], "high": [6e-3, 1, 1] } },
           "young": 1e10, "density": 2500, "poisson": 0.25 })";
  const auto plan = plan_of(block(6, 1, 1, breakable(tuler_butcher), more));
  const Model& model = *plan->model;
  EXPECT_EQ(model.materials[1].failures.front().number, 1u);
  const double step = 0.01 * model.step_limit.time_step;
  std::map<Spring, std::uint64_t> first;
  for (const bool cut_off : {false, true}) {
    auto simulation = std::make_unique<Simulation>(model, 1);
    while (simulation->time() < 1e-6) {
      if (cut_off && simulation->steps() == 20)
        simulation = contract::restarted(*simulation, model, 1);
      lead(*simulation, strained(model, 0.01), step);
    }
    const std::map<Spring, std::uint64_t> found = steps_of(*simulation);
    const auto late = static_cast<std::uint64_t>(std::ceil(0.25e-6 / step)),
               early = static_cast<std::uint64_t>(std::ceil(0.125e-6 / step));
    EXPECT_EQ(found, (std::map<Spring, std::uint64_t>{
                         {{0, 1}, late}, {{1, 2}, early}, {{2, 3}, early}, {{3, 4}, early}}));
  }
}

struct Body {
  const char* name;
  std::string scene;
};
std::vector<Body> bodies() {
  const std::string failure = both(tuler_butcher, limit("strain", "3 %"));
  return {{"grid", block(5, 4, 7, breakable(failure))},
          {"free membrane",
           block(5, 4, 7, R"("membrane": "I-m", "poisson": 0.1, "failure": )" + failure)},
          {"floats", in_floats(block(5, 4, 7, breakable(failure)))},
          {"random",
           listed_scene(random_lattice(6, 6, 6), R"("membrane": "none", "failure": )" + failure)},
          {"random in floats",
           in_floats(listed_scene(random_lattice(6, 6, 6),
                                  R"("membrane": "none", "failure": )" + failure))}};
}

TEST(FailureMemory, ThreadsAndRestartsChangeNoBits) {
  for (const Body& body : bodies()) {
    const auto plan = plan_of(body.scene);
    const Model& model = *plan->model;
    const auto run = [&](int threads, bool cut_off) {
      // Strains springs by a few thresholds.
      const double speed = 3 * threshold * model.body.grid.spacing / model.step_limit.time_step;
      auto simulation = std::make_unique<Simulation>(model, threads);
      simulation->set_velocities(
          noise(3 * model.body.particles, speed),
          std::vector<double>(model.degrees_of_freedom == 4 ? model.body.particles : 0, 0.0));
      const int steps = 150;
      for (int n = 0; n < steps; ++n) {
        if (cut_off && n % 29 == 28) simulation = contract::restarted(*simulation, model, threads);
        simulation->step(0.4 * model.step_limit.time_step);
      }
      std::vector<std::tuple<std::uint64_t, Particle, Particle, double>> log;
      for (const Breakage& one : simulation->breakages())
        log.emplace_back(one.step, one.a, one.b, one.elongation);
      return std::pair(simulation->hash(), log);
    };
    const auto whole = run(1, false);
    std::set<std::uint64_t> steps;
    for (const auto& breakage : whole.second) steps.insert(std::get<0>(breakage));
    std::printf("%s: %zu springs broke in %zu different steps\n", body.name, whole.second.size(),
                steps.size());
    EXPECT_GT(whole.second.size(), 20u) << body.name;
    EXPECT_GT(steps.size(), 10u) << body.name;
    for (const int threads : {1, 2, 3})
      for (const bool cut_off : {false, true})
        EXPECT_EQ(run(threads, cut_off), whole)
            << body.name << ", " << threads << " threads" << (cut_off ? ", cut off" : "");
  }
}

TEST(FailureMemory, CheckpointsOfEqualStatesHaveEqualBytes) {
  const auto plan = plan_of(block(5, 4, 7, breakable(tuler_butcher)));
  const Model& model = *plan->model;
  Simulation simulation(model, 2);
  const auto bytes = [](Simulation& of) {
    return contract::saved([&](Archive& archive) { of.archive(archive); });
  };
  const std::size_t before = bytes(simulation).size();
  // Below the threshold no spring keeps anything; springs along x keep a number above it.
  lead(simulation, strained(model, 0.9 * threshold), 1e-8);
  EXPECT_EQ(bytes(simulation).size(), before);
  const std::vector<double> u = strained(model, 1.5 * threshold);
  std::size_t above = 0;
  for_strains(model, u, [&](Spring, double e) { above += e > threshold ? 1 : 0; });
  lead(simulation, u, 1e-8);
  EXPECT_GT(above, 0u);
  EXPECT_EQ((bytes(simulation).size() - before) % above, 0u);
  EXPECT_GT(bytes(simulation).size(), before);
  const auto again = contract::restarted(simulation, model, 2);
  EXPECT_EQ(bytes(*again), bytes(simulation));
  // A broken spring keeps nothing.
  for (int n = 0; n < 2; ++n) lead(simulation, strained(model, 0.2), 1e-6);
  lead(simulation, strained(model, 0), 1e-8);
  const std::size_t logged = simulation.breakages().size() * sizeof(Breakage);
  EXPECT_GT(logged, 0u);
  EXPECT_EQ(bytes(simulation).size(), before + logged);
}

/// The pair of particles of a free oscillation.
TEST(FailureMemory, FatigueCountsTheCyclesOfAnOscillator) {
  for (const double cycles : {1.0, 2.0, 7.0}) {
    const auto plan = plan_of(with_plugins(block(
        2, 1, 1,
        breakable(R"({ "type": "failures.fatigue", "limit": 0.001, "strict": true, "cycles": )" +
                  std::to_string(cycles) + " }"))));
    const Model& model = *plan->model;
    const double k = model.springs.spring(0, 0, model.springs.neighbours.front().site.spring_class)
                         .stiffness,
                 omega = std::sqrt(2 * k / model.mass(0)), amplitude = 2e-6, step = 1e-3 / omega;
    Simulation simulation(model, 1);
    const double v = amplitude * omega / 2;
    simulation.set_velocities({-v, 0, 0, v, 0, 0}, {});
    const double expected = (std::asin(0.5) + (cycles - 1) * 2 * std::numbers::pi) / omega;
    while (simulation.breakages().empty() && simulation.time() < 2 * expected)
      simulation.step(step);
    ASSERT_EQ(simulation.breakages().size(), 1u) << cycles;
    const Breakage& breakage = simulation.breakages().front();
    EXPECT_NEAR(breakage.time, expected, 1e-4 * expected + 2 * step) << cycles;
    EXPECT_NEAR(breakage.elongation, 1e-6, 2 * step * amplitude * omega);
  }
}

TEST(FailureMemory, ACriterionOfSomebodyElseKeepsTheContract) {
  Host host({HYPERLATTICE_BUILD "/tests/truth_plugins", HYPERLATTICE_BUILD "/lib/hyperlattice"});
  const Component* component = host.find("failures.fatigue");
  ASSERT_NE(component, nullptr) << host.why_not("failures.fatigue");
  std::set<std::string> passed;
  for (const contract::Check& check : contract::check(*component, host, around)) {
    EXPECT_EQ(check.verdict, contract::Verdict::passed) << check.name << ": " << check.detail;
    passed.insert(check.name);
  }
  EXPECT_EQ(passed.size(), 7u);
  EXPECT_EQ(passed.count("memory"), 1u);
}

}  // namespace failure_memory_test
