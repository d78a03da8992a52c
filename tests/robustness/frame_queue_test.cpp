// Frames that are written beside the steps: the same files, byte for byte, as frames that are
// written between the steps, in the same order.
#include <support/program.hpp>

#include <gtest/gtest.h>

#include <map>

namespace hyperlattice::test {
namespace frame_queue_test {

/// A sphere that breaks, with writers of every kind. A probe asks for a field of the same times.
nlohmann::json watched_sphere() {
  nlohmann::json scene = small_sphere();
  nlohmann::json& pipeline = scene["pipeline"];
  pipeline[1]["failure"] = {{"type", "failures.elongation"}, {"limit", "1 um"}};
  pipeline[3]["energy_tolerance"] = 0;
  for (const char* codec : {"zlib", "lz4", "none"})
    pipeline.push_back({{"type", "writers.vtu"},
                        {"name", codec},
                        {"codec", codec},
                        {"every", "0.4 us"},
                        {"fields", {"displacement", "material", "damage", "broken_open"}}});
  pipeline.push_back({{"type", "writers.csv"}, {"every", "1 us"}, {"deformed", true}});
  pipeline.push_back(
      {{"type", "writers.picture"}, {"every", "2 us"}, {"width", 200}, {"height", 200}});
  pipeline.push_back({{"type", "probes.region"}, {"region", "inner_surface"}, {"every", "0.2 us"}});
  return scene;
}

std::map<std::string, std::string> frames_in(const std::string& folder) {
  std::map<std::string, std::string> frames;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().filename() != "summary.json" &&
        entry.path().filename() != "files.csv")
      frames[std::filesystem::relative(entry.path(), folder).string()] =
          contents(entry.path().string());
  return frames;
}

TEST(FrameQueue, LeavesTheSameFilesWithAnyNumberOfThreads) {
  const Folder folder("frame_queue");
  const std::string file = write_scene(folder, watched_sphere());
  std::map<std::string, std::string> first;
  for (const char* threads : {"1", "2", "4"}) {
    const std::string out = folder.file(threads);
    const Result result = run_program({"run", file, "--out", out, "--threads", threads});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_GT(read_json(out + "/summary.json")["broken_springs"]["open"], 0);
    auto frames = frames_in(out);
    if (first.empty()) first = frames;
    ASSERT_GT(frames.size(), 3 * 25U);
    for (const auto& [name, bytes] : first)
      EXPECT_TRUE(frames[name] == bytes) << name << " with " << threads << " threads";
    EXPECT_EQ(frames.size(), first.size()) << threads;
  }
}

TEST(FrameQueue, PutsTheFramesIntoTheCollectionInTheirOrder) {
  const Folder folder("frame_queue");
  const std::string out = folder.file("out");
  const Result result =
      run_program({"run", write_scene(folder, watched_sphere()), "--out", out, "--threads", "2"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string collection = contents(out + "/lz4/frames.pvd");
  double last = -1;
  int entries = 0;
  for (std::size_t at = collection.find("timestep=\""); at != std::string::npos;
       at = collection.find("timestep=\"", at + 1), ++entries) {
    const double time = std::stod(collection.substr(at + 10));
    EXPECT_GT(time, last);
    last = time;
    const std::string number = std::to_string(1'000'000 + entries).substr(1);
    const std::size_t end = collection.find('\n', at);
    EXPECT_NE(collection.substr(at, end - at).find("frames_" + number + ".vtu"), std::string::npos);
  }
  EXPECT_EQ(entries, 26);
}

}  // namespace frame_queue_test
}  // namespace hyperlattice::test
