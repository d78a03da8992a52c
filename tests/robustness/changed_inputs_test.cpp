// A scene stays the same, and a file that it uses changes. `--resume` then refuses and keeps the
// checkpoint, and a study repeats the run; both name the change. A folder that is moved as a whole
// still works.
#include <hyperlattice/kernels/processor.hpp>

#include <gtest/gtest.h>
#include <support/program.hpp>

namespace hyperlattice::test {
namespace changed_inputs_test {

using nlohmann::json;
namespace fs = std::filesystem;
using Words = std::vector<std::string>;

class ChangedInputs : public testing::Test {
 protected:
  json block(const char* shape, const char* end_time) const {
    json scene = json::parse(R"({ "format": "hyperlattice/1", "pipeline": [
      { "type": "lattices.cubic", "spacing": "0.5 mm" },
      { "type": "materials.elastic", "young": "10 GPa", "poisson": 0.2, "density": 2500, "membrane": "I-m",
        "failure": { "type": "failures.elongation", "limit": 1 } },
      { "type": "loads.fixed", "on": "z_max" },
      { "type": "loads.force", "on": "z_min", "total": [0, 0, "-100 N"] },
      { "type": "solvers.explicit" },
      { "type": "probes.region", "region": "all", "component": "z" } ] })");
    scene["pipeline"][0]["shape"] = json::parse(shape);
    scene["pipeline"][4]["end_time"] = end_time;
    return scene;
  }
  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder.file(name), std::ios::binary) << bytes;
  }
  static std::string voxels(int solid) {
    std::string bytes;
    for (int n = 0; n < 1000; ++n) bytes += n % 10 < solid ? '\1' : '\2';
    return bytes;
  }
  static constexpr const char* voxel_shape =
      R"({ "voxels": { "file": "body.raw", "counts": [10, 10, 10], "voxel": "1 mm", "values": [1] } })";

  /// Kills a run at its first checkpoint.
  void cut_off(const json& scene) {
    file = write_scene(folder, scene);
    Launch launch;
    launch.meanwhile = [&](pid_t child) {
      EXPECT_TRUE(wait_until([&] { return fs::exists(out + "/checkpoint.bin"); }));
      kill(child, SIGKILL);
    };
    run_program(
        {"run", file, "--out", out, "--threads", "1", "--checkpoint-every", "0.001", "--quiet"},
        launch);
    checkpoint = contents(out + "/checkpoint.bin");
  }
  void expect_refused(const std::string& because, const Words& environment = {}) {
    Launch launch;
    launch.environment = environment;
    const Result result =
        run_program({"run", file, "--out", out, "--threads", "1", "--quiet", "--resume"}, launch);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_NE(result.err.find("a checkpoint of this scene and of all that it uses, but " + because),
              std::string::npos)
        << result.err;
    EXPECT_TRUE(contents(out + "/checkpoint.bin") == checkpoint);
  }

  Folder folder{"changed_inputs"};
  std::string file, out = folder.file("out"), checkpoint;
};

TEST_F(ChangedInputs, ResumeNamesAVoxelImageAndNumericModes) {
  write("body.raw", voxels(3));
  cut_off(block(voxel_shape, "1 s"));
  write("body.raw", voxels(8));
  expect_refused("body.raw (/pipeline/0/shape/voxels/file) has changed");
  write("body.raw", voxels(3));
  expect_refused("the way of computing springs is exact in place of series",
                 {"HYPERLATTICE_SPRINGS=exact"});
  if (processor_instructions() != Instructions::baseline)
    expect_refused("the instruction set is baseline in place of ",
                   {"HYPERLATTICE_INSTRUCTIONS=baseline"});
}

TEST_F(ChangedInputs, ResumeNamesATableOfPoints) {
  std::string table = "x,y,z,volume\n";
  for (int n = 0; n < 125; ++n)
    table += std::to_string(n % 5) + "," + std::to_string(n / 5 % 5) + "," +
             std::to_string(n / 25) + ",1\n";
  write("points.csv", table);
  json scene = block("null", "1 s");
  scene["pipeline"][0] = {{"type", "lattices.points"},
                          {"points", "points.csv"},
                          {"scale", "1 mm"},
                          {"coordination", 14}};
  scene["pipeline"][1].erase("membrane");
  scene["pipeline"][1]["poisson"] = 0.25;
  cut_off(scene);
  write("points.csv", table + " \n");  // every byte counts
  expect_refused("points.csv (/pipeline/0/points) has changed");
}

TEST_F(ChangedInputs, ResumeNamesARebuiltPlugin) {
  const fs::path name = "failures.misbehaving.so";  // sound unless the environment names a fault
  fs::create_directory(folder.file("mine"));
  fs::copy(fs::path(HYPERLATTICE_BUILD) / "tests/bad_plugins/misbehaving" / name,
           fs::path(folder.file("mine")) / name);
  json scene = block(R"({ "box": { "low": [0, 0, 0], "high": ["5 mm", "5 mm", "5 mm"] } })", "1 s");
  scene["plugins"] = {"mine"};
  scene["pipeline"][1]["failure"] = {{"type", "failures.misbehaving"}, {"limit", 1}};
  cut_off(scene);
  std::ofstream(fs::path(folder.file("mine")) / name, std::ios::binary | std::ios::app) << ' ';
  expect_refused("the plugin failures.misbehaving (" +
                 (fs::path(folder.file("mine")) / name).string() + ") has changed");
}

TEST_F(ChangedInputs, AStudyRunsAgain) {
  write("body.raw", voxels(3));
  json study = {{"format", "hyperlattice-study/1"},
                {"scene", block(voxel_shape, "20 us")},
                {"vary", {{"E", {{"/pipeline/1/young", {"10 GPa", "20 GPa"}}}}}},
                {"repeats", 1},
                {"truth", {{"value", -1e-6}}},
                {"compare", {{"end", {{"probe", "region"}, {"column", "displacement_z_mean"}}}}}};
  std::ofstream(folder.file("study.json")) << study.dump();
  const auto conduct = [&](const Words& more = {}) {
    Words words{"study", folder.file("study.json"), "--out", out, "--threads", "1", "--json"};
    words.insert(words.end(), more.begin(), more.end());
    const Result result = run_program(words);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return std::pair{json::parse(result.out), result.err};
  };
  const auto first = conduct().first;
  EXPECT_NE(conduct().second.find("there already"), std::string::npos);
  write("body.raw", voxels(8));
  const auto [second, told] = conduct();
  EXPECT_NE(told.find("runs again: body.raw (/pipeline/0/shape/voxels/file) has changed"),
            std::string::npos)
      << told;
  EXPECT_EQ(told.find("there already"), std::string::npos) << told;
  EXPECT_NE(second["rows"][0]["error"], first["rows"][0]["error"]);
  EXPECT_NE(second["rows"][0]["identity"], first["rows"][0]["identity"]);
  EXPECT_EQ(second["rows"][0]["error"], conduct({"--fresh"}).first["rows"][0]["error"]);
}

TEST_F(ChangedInputs, AMovedFolderRunsAndKeepsItsIdentity) {
  fs::create_directory(folder.file("project"));
  write("project/body.raw", voxels(3));
  std::ofstream(folder.file("project/scene.json")) << block(voxel_shape, "10 us").dump();
  ASSERT_EQ(run_program({"run", folder.file("project/scene.json"), "--out",
                         folder.file("project/out"), "--quiet"})
                .exit_code,
            0);
  EXPECT_EQ(read_json(folder.file(
                "project/out/scene.resolved.json"))["pipeline"][0]["shape"]["voxels"]["file"],
            "../body.raw");
  fs::rename(folder.file("project"), folder.file("moved"));
  const Result again =
      run_program({"run", folder.file("moved/out/scene.resolved.json"), "--out", out, "--quiet"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  const json before = read_json(folder.file("moved/out/summary.json")),
             now = read_json(out + "/summary.json");
  EXPECT_EQ(before["state_hash"], now["state_hash"]);
  for (std::size_t n = 0; n < before["identity"].size(); ++n)
    EXPECT_EQ(before["identity"][n]["content"], now["identity"][n]["content"]) << n;
  // The results are outside of the folder that holds the scene and the file, so that the path is
  // absolute.
  EXPECT_EQ(read_json(out + "/scene.resolved.json")["pipeline"][0]["shape"]["voxels"]["file"],
            folder.file("moved/body.raw"));
}

}  // namespace changed_inputs_test
}  // namespace hyperlattice::test
