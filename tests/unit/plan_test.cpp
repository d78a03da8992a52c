// The plan against the actual run: bytes of memory exactly, steps, and the kernel for each choice
// in a scene.
#include "support/program.hpp"

#include <base/own_files.hpp>
#include <plan/calibration.hpp>
#include <plan/estimates.hpp>
#include <plan/plan.hpp>
#include <plan/precision.hpp>
#include <plan/shortage.hpp>
#include <process/room.hpp>
#include <run/run.hpp>
#include <state/layout.hpp>
#include <state/simulation.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

namespace plan_test {
using namespace hyperlattice;
using test::small_sphere;

std::unique_ptr<Plan> plan_of(const nlohmann::json& scene, int threads = 1) {
  const test::Folder folder("plan");
  setenv("HYPERLATTICE_PLUGIN_PATH", HYPERLATTICE_BUILD "/lib/hyperlattice", 1);
  static Host host;
  return make_plan(read_scene(test::write_scene(folder, scene), {}, host), threads);
}

bool leaves_out(const Plan& plan, const std::string& what) {
  return std::any_of(plan.left_out.begin(), plan.left_out.end(),
                     [&](const LeftOut& left) { return left.what == what; });
}

TEST(Plan, warnings_of_the_scene_come_first) {
  const test::Folder folder("plan");
  setenv("HYPERLATTICE_PLUGIN_PATH", HYPERLATTICE_BUILD "/lib/hyperlattice", 1);
  static Host host;
  auto scene = read_scene(test::write_scene(folder, small_sphere()), {}, host);
  scene->warnings = {"/pipeline/2/old: of the scene"};
  const auto plan = make_plan(std::move(scene), 1);
  ASSERT_FALSE(plan->model->warnings.empty());
  EXPECT_EQ(plan->model->warnings.front(), "/pipeline/2/old: of the scene");
}

TEST(Plan, memory_counts_the_copies_of_frames_that_wait) {
  nlohmann::json scene = small_sphere();
  const double without = plan_of(scene, 2)->memory_bytes;
  scene["pipeline"].push_back({{"type", "writers.vtu"}, {"fields", {"velocity", "height"}}});
  const auto plan = plan_of(scene, 2);
  const auto particles = static_cast<double>(plan->model->body.particles);
  // The writer's own arrays: points and fields in single precision, and cells.
  const double encoded = particles * (4 * (3 + 4) + 4 + 4 + 1);
  // Positions, and twice the fields: the present state hands its own over.
  EXPECT_NEAR(plan->memory_bytes - without, particles * 8 * (3 + 2 * 4) + encoded, 1);
  EXPECT_NEAR(plan_of(scene, 1)->memory_bytes - plan_of(small_sphere(), 1)->memory_bytes,
              particles * 8 * (3 + 4) + encoded, 1);
}

TEST(Plan, memory_counts_the_pixels_of_pictures) {
  const auto bytes = [](int width, int height) {
    nlohmann::json scene = small_sphere();
    scene["pipeline"].push_back(
        {{"type", "writers.picture"}, {"width", width}, {"height", height}});
    return plan_of(scene, 1)->memory_bytes;
  };
  // Each pixel has three bytes of colour, and four fine pixels of a depth and a particle.
  EXPECT_NEAR(bytes(1600, 1200) - bytes(64, 64), (1600.0 * 1200 - 64 * 64) * (3 + 4 * (4 + 4)), 1);
}

TEST(Plan, small_bodies_take_few_threads_unless_a_number_is_asked_for) {
  EXPECT_EQ(Threads::up_to(8).of(432), 1);
  EXPECT_EQ(Threads::up_to(8).of(3 * 4096), 3);
  EXPECT_EQ(Threads::up_to(8).of(4'000'000'000), 8);
  EXPECT_EQ(Threads(8).of(432), 8);
  EXPECT_TRUE(Threads::up_to(8).allow(3));
  EXPECT_FALSE(Threads::up_to(8).allow(9));
  EXPECT_FALSE(Threads(8).allow(3));
}

TEST(Plan, warns_of_loads_that_do_nothing) {
  const auto warned = [](const nlohmann::json& load, const nlohmann::json& solver) {
    auto scene = small_sphere();
    scene["pipeline"] = {scene["pipeline"][0], scene["pipeline"][1], load, solver};
    const auto plan = plan_of(scene);
    return std::any_of(plan->model->warnings.begin(), plan->model->warnings.end(),
                       [](const std::string& text) {
                         return text.find("does nothing in this run") != std::string::npos;
                       });
  };
  const auto expression = [](const char* text) {
    return nlohmann::json{{"type", "loads.expression"},
                          {"on", "outer_surface"},
                          {"total", {1, 0, 0}},
                          {"expression", text}};
  };
  const nlohmann::json velocity{
      {"type", "loads.velocity"}, {"on", "outer_surface"}, {"value", {1, 0, 0}}};
  const nlohmann::json held{{"type", "loads.fixed"}, {"on", "outer_surface"}};
  const nlohmann::json rest{{"type", "solvers.static"}},
      later{{"type", "solvers.static"}, {"end_time", "1 us"}};
  const nlohmann::json steps{{"type", "solvers.explicit"}, {"end_time", "1 us"}};
  EXPECT_TRUE(warned(expression("t / 1e-5"), rest));
  EXPECT_FALSE(warned(expression("t / 1e-5"), later));
  EXPECT_FALSE(warned(expression("t / 1e-5"), steps));
  EXPECT_TRUE(warned(expression("t > 2e-6 ? 1 : 0"), steps));
  EXPECT_TRUE(warned(velocity, rest));
  EXPECT_FALSE(warned(velocity, later));
  EXPECT_FALSE(warned(held, rest));
}

TEST(Plan, bytes_are_those_of_the_state) {
  for (const char* membrane : {"none", "I-m", "III"})
    for (const int threads : {1, 2, 5}) {
      auto scene = small_sphere();
      scene["pipeline"][1]["membrane"] = membrane;
      scene["pipeline"][1]["poisson"] = std::string(membrane) == "none"  ? 0.25
                                        : std::string(membrane) == "III" ? 0.2
                                                                         : 0.1;
      const auto plan = plan_of(scene, threads);
      const Simulation simulation(*plan->model, threads);
      const auto particles = static_cast<double>(plan->model->body.particles);
      EXPECT_DOUBLE_EQ(plan->bytes_per_particle * particles, simulation.bytes()) << membrane;
      EXPECT_GT(plan->memory_bytes, simulation.bytes() + simulation.scratch_bytes());
      EXPECT_GE(plan->bytes_per_particle, 2 * 8 * plan->model->degrees_of_freedom + 2);
    }
}

TEST(Plan, cells_cost_little_and_whole_particles_nothing) {
  auto scene = small_sphere();
  const auto whole = plan_of(scene);
  EXPECT_TRUE(leaves_out(*whole, "weights at the surface"));
  scene["pipeline"][0]["boundary"] = "cells";
  for (const int threads : {1, 3}) {
    const auto cells = plan_of(scene, threads);
    const Model& model = *cells->model;
    const auto particles = static_cast<double>(model.body.particles);
    EXPECT_FALSE(leaves_out(*cells, "weights at the surface"));
    EXPECT_DOUBLE_EQ(cells->bytes_per_particle * particles, Simulation(model, threads).bytes());

    double sites = 0, vectors = 0;
    std::set<std::uint32_t> sets{whole_set};  // always present, even if no vector is whole
    const auto layout = make_layout(model, threads);
    for (const BlockLayout& block : layout->blocks) {
      sites += static_cast<double>(block.sites);
      vectors += static_cast<double>(block.weight_sets.size());
      sets.insert(block.weight_sets.begin(), block.weight_sets.end());
    }
    constexpr double
        // Bytes per site; then bytes for the shares of particles and nine springs in a vector.
        state = 2 * 4 * 8 + 2,
        set = 10 * 8 * 8;
    EXPECT_DOUBLE_EQ(cells->bytes_per_particle * particles,
                     state * sites + 4 * vectors + set * static_cast<double>(sets.size()));
    // Vectors share their sets, even in a ball with many surface particles.
    EXPECT_LT(static_cast<double>(sets.size()), vectors);
  }
}

TEST(Plan, writes_no_more_frames_than_steps) {
  auto scene = small_sphere();
  scene["pipeline"].push_back({{"type", "writers.vtu"}, {"every", 1e-30}});
  const auto often = plan_of(scene);
  scene["pipeline"].back()["every"] = often->stages.front().plan.time_step;
  const auto each_step = plan_of(scene);
  EXPECT_GT(often->output_bytes, 1e6);
  EXPECT_NEAR(often->output_bytes, each_step->output_bytes, 0.05 * often->output_bytes);
}

TEST(Plan, says_what_a_run_has_too_little_of) {
  const auto plan = plan_of(small_sphere());
  EXPECT_TRUE(shortages(*plan, ".").empty());
  plan->memory_bytes = 1e18;
  plan->output_bytes = 1e18;
  const auto found = shortages(*plan, "not/there/yet");
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NE(found[0].find("the run needs 1e+06 TB"), std::string::npos) << found[0];
  EXPECT_NE(found[1].find("will write about 1e+06 TB"), std::string::npos) << found[1];
  EXPECT_THROW(refuse_shortage(*plan, "."), OutsideError);
}

TEST(Plan, counts_the_files_of_an_earlier_run_as_free_disk_and_no_others) {
  const auto plan = plan_of(small_sphere());
  const test::Folder folder("shortage");
  std::ofstream(folder.file("history.csv")).close();
  std::filesystem::resize_file(folder.file("history.csv"), 1'000'000'000'000);  // sparse file
  // The run would write more than the disk has room for, unless the old file counts as free.
  plan->output_bytes = 1.5 * (disk_room(folder.path()).bytes + 5e11);
  const auto found = shortages(*plan, folder.path());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NE(found[0].find("too little disk"), std::string::npos) << found[0];
  std::ofstream(folder.file(own_files_list))
      << own_file_line("history.csv", {}) << own_file_line("removed.csv", {});
  EXPECT_TRUE(shortages(*plan, folder.path()).empty());
}

/// A body of a few thousand particles, all in motion. Its writers show the start, the end, and the
/// state of rest if the first stage finds one.
nlohmann::json moved_box(const nlohmann::json& lattice, bool first_to_rest) {
  nlohmann::json scene;
  scene["format"] = "hyperlattice/1";
  scene["pipeline"] = {
      lattice,
      {{"type", "materials.elastic"}, {"young", "10 GPa"}, {"poisson", 0.2}, {"density", 2500}},
      {{"type", "loads.fixed"}, {"on", "z_min"}},
      {{"type", "loads.force"}, {"on", "z_max"}, {"total", {1, 0, 10}}}};
  scene["pipeline"][1]["membrane"] = lattice["type"] == "lattices.random" ? "I" : "I-m";
  if (first_to_rest) scene["pipeline"].push_back({{"type", "solvers.static"}});
  scene["pipeline"].push_back({{"type", "solvers.explicit"}, {"end_time", "10 us"}});
  return scene;
}

nlohmann::json box(const char* lattice, const char* width, const char* height) {
  return {{"type", lattice},
          {"spacing", "1 mm"},
          {"shape", {{"box", {{"low", {0, 0, 0}}, {"high", {width, width, height}}}}}}};
}

/// Adds a writer to the scene, runs the scene, and compares the files with the plan.
void compare_output(nlohmann::json scene, const char* writer, const char* every,
                    std::size_t frames) {
  scene["pipeline"].push_back({{"type", writer}, {"every", every}});
  const auto plan = plan_of(scene);
  const test::Folder folder("planned_output");
  ASSERT_EQ(run(*plan, {.directory = folder.file("out"), .quiet = true}), 0);
  double bytes = 0, largest = 0;
  std::size_t shown = 0;
  const std::string ending = std::string(writer) == "writers.csv" ? ".csv" : ".vtu";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.file("out"))) {
    if (!entry.is_regular_file()) continue;
    const auto size = static_cast<double>(entry.file_size());
    bytes += size;
    if (!entry.path().filename().string().starts_with("frames_0") ||
        entry.path().extension() != ending)
      continue;
    ++shown;
    largest = std::max(largest, size);
  }
  const Stage& stage = *plan->scene->of(Family::writers).front();
  EXPECT_EQ(shown, frames);
  EXPECT_EQ(frames_of(*plan, stage), static_cast<double>(frames));
  EXPECT_LT(plan->output_bytes, 2 * bytes) << bytes;
  EXPECT_GT(plan->output_bytes, 0.5 * bytes) << bytes;
  EXPECT_LT(frame_bytes(*plan, stage), 2 * largest) << largest;
  EXPECT_GT(frame_bytes(*plan, stage), 0.5 * largest) << largest;
}

TEST(Plan, says_about_how_many_bytes_a_run_writes) {
  // `large` has more particles than the trial frame of the plan, `list` has fewer.
  const auto large = box("lattices.cubic", "20 mm", "25 mm"),
             list = box("lattices.random", "8 mm", "12 mm");
  for (const char* writer : {"writers.csv", "writers.vtu"}) {
    SCOPED_TRACE(writer);
    compare_output(small_sphere(), writer, "0.5 us", 21);
    compare_output(moved_box(list, false), writer, "20 us", 2);
    compare_output(moved_box(large, false), writer, "4 us", 4);
    compare_output(moved_box(large, true), writer, "60 us", 3);
  }
}

TEST(Plan, says_how_many_bytes_a_frame_of_a_region_has) {
  auto scene = moved_box(box("lattices.cubic", "20 mm", "25 mm"), false);
  scene["pipeline"].push_back({{"type", "writers.csv"}});
  const auto all = plan_of(scene);
  scene["pipeline"].back()["region"] = "z_max";
  const auto layer = plan_of(scene);
  EXPECT_NEAR(frame_bytes(*layer, *layer->scene->of(Family::writers).front()) /
                  frame_bytes(*all, *all->scene->of(Family::writers).front()),
              0.04, 0.004);
}

// The speed depends on the machine and its load, so that the test cannot expect a value.
TEST(Plan, measures_its_run_time) {
  const auto plan = plan_of(small_sphere());
  plan->expected_seconds = -1;
  calibrate_run_time(*plan);
  EXPECT_GT(plan->expected_seconds, 0);
  EXPECT_LT(plan->expected_seconds, 600);
}

TEST(Plan, carries_only_what_the_scene_needs) {
  auto scene = small_sphere();
  const auto plain = plan_of(scene);
  EXPECT_EQ(plain->model->degrees_of_freedom, 4);
  EXPECT_TRUE(leaves_out(*plain, "failure"));
  EXPECT_TRUE(leaves_out(*plain, "local damping"));
  EXPECT_FALSE(leaves_out(*plain, "fourth dimension"));

  scene["pipeline"][1]["membrane"] = "none";
  scene["pipeline"][1].erase("poisson");
  scene["pipeline"][1]["failure"] = {{"type", "failures.elongation"}, {"limit", "3.5e-3 mm"}};
  scene["pipeline"][3]["damping"] = 0.5;
  const auto flat = plan_of(scene);
  EXPECT_EQ(flat->model->degrees_of_freedom, 3);
  EXPECT_TRUE(leaves_out(*flat, "fourth dimension"));
  EXPECT_FALSE(leaves_out(*flat, "failure"));
  EXPECT_TRUE(leaves_out(*flat, "memory of failure laws"));
  EXPECT_FALSE(leaves_out(*flat, "local damping"));
  EXPECT_LT(flat->bytes_per_particle, plain->bytes_per_particle);

  nlohmann::json& failure = scene["pipeline"][1]["failure"];
  failure = {failure, {{"type", "failures.tuler_butcher"}, {"threshold", 1e-3}, {"impulse", 1e-9}}};
  const auto damaged = plan_of(scene);
  EXPECT_FALSE(leaves_out(*damaged, "memory of failure laws"));
  EXPECT_EQ(damaged->bytes_per_particle, flat->bytes_per_particle);
}

TEST(Plan, fields_that_nobody_asks_for_are_left_out) {
  auto scene = small_sphere();
  scene["pipeline"].push_back({{"type", "writers.vtu"}, {"fields", {"displacement", "height"}}});
  const auto plan = plan_of(scene);
  EXPECT_TRUE(leaves_out(*plan, "field velocity"));
  EXPECT_TRUE(leaves_out(*plan, "field damage"));
  EXPECT_FALSE(leaves_out(*plan, "field displacement"));
  EXPECT_FALSE(leaves_out(*plan, "field height"));
}

TEST(Plan, steps_are_safe_and_land_on_the_end) {
  auto scene = small_sphere();
  scene["pipeline"][3]["damping"] = 0.8;
  const auto plan = plan_of(scene);
  const SolverPlan& solver = plan->stages.at(0).plan;
  EXPECT_NEAR(solver.stable_time_step, plan->model->step_limit.time_step / std::sqrt(1.8),
              1e-9 * solver.stable_time_step);
  EXPECT_LE(solver.time_step, 0.9 * solver.stable_time_step * (1 + 1e-12));
  EXPECT_GE(static_cast<double>(solver.steps) * solver.time_step, 10e-6 * (1 - 1e-9));
  EXPECT_EQ(plan->end_time(), 10e-6);
}

// A float resolves a displacement u to u / 2^24. At spacing l it therefore resolves strains to u /
// (2^24 l).
TEST(Plan, refuses_floats_where_they_would_not_know_the_strain) {
  const auto faults = [](double way_in_spacings, double limit_strain) {
    auto scene = small_sphere();
    const double spacing = plan_of(scene)->model->body.grid.spacing, end = 10e-6;
    scene["precision"] = "float";
    if (limit_strain > 0)
      scene["pipeline"][1]["failure"] = {{"type", "failures.strain"}, {"limit", limit_strain}};
    const nlohmann::json flight = {{"type", "loads.start_velocity"},
                                   {"linear", {way_in_spacings * spacing / end, 0, 0}}};
    scene["pipeline"].insert(scene["pipeline"].begin() + 3, flight);
    try {
      plan_of(scene);
    } catch (const InputError& error) {
      return error.faults();
    }
    return std::vector<Fault>{};
  };
  const double known = std::ldexp(1, -24);
  EXPECT_TRUE(faults(0.99e-6 / known, 0).empty());
  const auto far = faults(1.01e-6 / known, 0);
  ASSERT_EQ(far.size(), 1u);
  EXPECT_EQ(far.front().pointer, "/precision");
  EXPECT_NE(far.front().expected.find("double"), std::string::npos);
  EXPECT_TRUE(faults(4, 101 * 4 * known).empty());
  EXPECT_EQ(faults(4, 99 * 4 * known).size(), 1u);
}

// Each particle moves on a circle no wider than the body.
TEST(Plan, floats_bear_a_small_body_that_spins) {
  const auto accepted = [](double turns, double drift_in_spacings) {
    auto scene = small_sphere();
    const double spacing = plan_of(scene)->model->body.grid.spacing, end = 10e-6;
    scene["precision"] = "float";
    const nlohmann::json start = {{"type", "loads.start_velocity"},
                                  {"linear", {drift_in_spacings * spacing / end, 0, 0}},
                                  {"angular", {0, 0, turns * 2 * 3.14159265358979 / end}}};
    scene["pipeline"].insert(scene["pipeline"].begin() + 3, start);
    try {
      plan_of(scene);
    } catch (const InputError&) {
      return false;
    }
    return true;
  };
  const double far = 1e-6 * std::ldexp(1, 24);  // spacings
  EXPECT_TRUE(accepted(far, 0));
  EXPECT_FALSE(accepted(far, 1.01 * far));
  EXPECT_TRUE(accepted(0.01, 0.9 * far));
}

TEST(Plan, warns_of_floats_that_have_become_coarse) {
  auto scene = small_sphere();
  scene["precision"] = "float";
  const auto plan = plan_of(scene);
  const double spacing = plan->model->body.grid.spacing, far = 1e-6 * spacing * std::ldexp(1, 24);
  EXPECT_EQ(precision_warning(*plan->model, 0.99 * far), "");
  EXPECT_NE(precision_warning(*plan->model, 1.01 * far).find("floats are coarse"),
            std::string::npos);
}

}  // namespace plan_test
