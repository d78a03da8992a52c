// Runs of the program that draw pictures by writers.render: threads, faults, disks, films.
#include <support/output.hpp>
#include <support/program.hpp>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace hyperlattice::test {
namespace render_runs_test {

using nlohmann::json;

Launch with(const std::string& setting) {
  Launch launch;
  launch.environment = {setting};
  return launch;
}

/// A scene of a breaking sphere with this writer.
json sphere_with(json writer) {
  json scene = small_sphere();
  scene["pipeline"][1]["failure"] = {{"type", "failures.elongation"}, {"limit", "1e-3 mm"}};
  writer.update({{"type", "writers.render"}, {"width", 200}, {"height", 150}});
  scene["pipeline"].push_back(writer);
  return scene;
}

TEST(RenderRuns, SameBitsForAnyThreadsAndNoDisplay) {
  const Folder folder("render_runs");
  const std::string scene = write_scene(
      folder,
      sphere_with(
          {{"every", "5 us"}, {"clip", {0, 0, 0, 1, -1, 0}}, {"smooth", 5}, {"cracks", true}}));
  for (const char* threads : {"1", "2"}) {
    const Result result = run_program(
        {"run", scene, "--out", folder.file(threads), "--threads", threads}, with("DISPLAY="));
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }
  for (const char* name : {"render_000000.png", "render_000001.png", "render_000002.png"}) {
    const std::string one = contents(folder.file("1/" + std::string(name)));
    EXPECT_GT(one.size(), 1000U);
    EXPECT_TRUE(one == contents(folder.file("2/" + std::string(name)))) << name;
  }
  EXPECT_NE(contents(folder.file("1/render_000000.png")),
            contents(folder.file("1/render_000002.png")));
}

TEST(RenderRuns, FaultsPointAtTheOption) {
  const Folder folder("render_faults");
  const std::string scene = write_scene(
      folder, sphere_with({{"clip", {1, 2}}, {"opacity", 0}, {"colour_by", "presure"}}));
  const Result result = run_program({"plan", scene});
  EXPECT_EQ(result.exit_code, 2);
  for (const char* pointer : {"/pipeline/4/opacity", "/pipeline/4/colour_by"})
    EXPECT_NE(result.err.find(pointer), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("pressure"), std::string::npos);  // the nearest valid name
}

TEST(RenderRuns, AFullDiskIsExitCode4) {
  const Folder folder("render_disk");
  const std::string scene = write_scene(folder, sphere_with({{"every", 0}, {"width", 2000}}));
  Launch limited;
  limited.file_limit = 20000;
  const Result result = run_program({"run", scene, "--out", folder.file("out")}, limited);
  EXPECT_EQ(result.exit_code, 4) << result.err;
}

/// Puts a program named ffmpeg into a folder. It writes its arguments to the last of them.
void fake_ffmpeg(const Folder& folder, const std::string& script) {
  std::ofstream(folder.file("ffmpeg")) << "#!/bin/sh\n" << script;
  std::filesystem::permissions(folder.file("ffmpeg"), std::filesystem::perms::owner_all);
}

TEST(RenderRuns, AFilmIsMadeOfAllFrames) {
  const Folder folder("render_film");
  fake_ffmpeg(folder, "for last; do :; done\necho \"$@\" > \"$last\"\n");
  const std::string scene = write_scene(folder, sphere_with({{"every", "5 us"}, {"movie", "mp4"}}));
  const Result result =
      run_program({"run", scene, "--out", folder.file("out")}, with("PATH=" + folder.path()));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string told = contents(folder.file("out/render.mp4"));
  EXPECT_NE(told.find("render_%06d.png"), std::string::npos) << told;
  EXPECT_TRUE(std::filesystem::exists(folder.file("out/render_000002.png")));
  EXPECT_FALSE(std::filesystem::exists(folder.file("out/render.mp4.part")));
}

TEST(RenderRuns, AnInterruptedRunGoesOnWithTheSameFilesAndFilm) {
  const Folder folder("render_resume");
  fake_ffmpeg(folder, "for last; do :; done\necho \"$@\" > \"$last\"\n");
  json scene = sphere_with({{"every", "2 us"}, {"movie", "mp4"}, {"cracks", true}});
  scene["pipeline"][3]["end_time"] = "40 us";
  const std::string file = write_scene(folder, scene);
  const auto run = [&](const std::string& out, std::vector<std::string> more, Launch launch) {
    std::vector<std::string> arguments{"run", file, "--out", folder.file(out), "--threads", "1"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    launch.environment = {"PATH=" + folder.path()};
    return run_program(arguments, launch);
  };
  const Result whole = run("whole", {}, {});
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  Launch interrupted;
  interrupted.meanwhile = [&](pid_t child) {
    wait_until([&] { return std::filesystem::exists(folder.file("parts/render_000003.png")); });
    kill(child, SIGINT);
  };
  ASSERT_EQ(run("parts", {}, interrupted).exit_code, 130);
  const Result resumed = run("parts", {"--resume"}, {});
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  for (int n = 0; n <= 20; ++n) {
    const std::string name = "/render_0000" + std::string(n < 10 ? "0" : "") + std::to_string(n);
    EXPECT_TRUE(contents(folder.file("parts" + name + ".png")) ==
                contents(folder.file("whole" + name + ".png")))
        << name;
  }
  EXPECT_EQ(contents(folder.file("parts/render.mp4")), contents(folder.file("whole/render.mp4")));
}

TEST(RenderRuns, AFilmThatFailsLeavesTheFrames) {
  const Folder folder("render_film_fails");
  fake_ffmpeg(folder, "echo no such encoder >&2\nexit 1\n");
  const std::string scene = write_scene(folder, sphere_with({{"every", "5 us"}, {"movie", "mp4"}}));
  const Result result =
      run_program({"run", scene, "--out", folder.file("out")}, with("PATH=" + folder.path()));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("no such encoder"), std::string::npos) << result.err;
  EXPECT_NE(read_json(folder.file("out/summary.json"))["warnings"].dump().find("no such encoder"),
            std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder.file("out/render.mp4")));
  EXPECT_TRUE(std::filesystem::exists(folder.file("out/render_000002.png")));
}

TEST(RenderRuns, ThePlanTellsThatNoFilmIsMade) {
  const Folder folder("render_no_film");
  const std::string scene = write_scene(folder, sphere_with({{"movie", "mp4"}}));
  const Result result = run_program({"plan", scene, "--json"}, with("PATH=/nowhere"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(json::parse(result.out)["warnings"].dump().find("ffmpeg"), std::string::npos);
}

}  // namespace render_runs_test
}  // namespace hyperlattice::test
