// Inputs that could use up time or memory are read quickly, or refused with the limit that they
// exceed.
#include "support/fake_components.hpp"
#include "support/output.hpp"

#include <base/input_file.hpp>

#include <gtest/gtest.h>

#include <sys/stat.h>

namespace limits_test {
using namespace hyperlattice;
using Json = nlohmann::ordered_json;

Json scene() {
  return Json::parse(R"({ "format": "hyperlattice/1", "pipeline": [
    { "type": "lattices.grid", "spacing": "1 mm", "shape": { "sphere": { "radius": "10 mm" } } },
    { "type": "materials.spring", "young": "10 GPa", "poisson": 0.2, "density": 2500 },
    { "type": "solvers.march", "end_time": "40 us" } ] })");
}

std::unique_ptr<Scene> read(const std::string& text) {
  static fakes::Catalogue catalogue;
  return read_scene_text(text, "scene.json", {}, catalogue);
}

/// The message of the refusal; "" if the input was accepted.
template <class Read>
std::string refusal(const Read& read) {
  try {
    read();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}
std::string refusal_of(const std::string& text) {
  return refusal([&] { read(text); });
}
bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Limits, ChainsOfRegions) {
  for (const bool forwards : {true, false})
    for (const int count : {60, 9'000}) {
      Json given = scene();
      // The regions are in the order of the file. Each uses the region before it, or the region
      // after it.
      const auto name = [&](int n) { return "r" + std::to_string(forwards ? n : count - 1 - n); };
      for (int n = 0; n < count; ++n) {
        const int place = forwards ? n : count - 1 - n;
        given["regions"][name(place)] = place == 0
                                            ? Json{{"sphere", {{"radius", 1}}}}
                                            : Json{{"intersection", {name(place - 1), "x_min"}}};
      }
      const std::string why = refusal_of(given.dump());
      EXPECT_EQ(has(why, "at most 64 levels of regions within regions"), count > 60)
          << why.substr(0, 300);
      EXPECT_LT(why.size(), 1000u);
    }
}

TEST(Limits, RegionsThatNameEachOtherTwice) {
  const auto doubled = [](int levels) {
    Json given = scene();
    given["regions"]["r0"] = {{"sphere", {{"radius", 1}}}};
    for (int n = 1; n <= levels; ++n)
      given["regions"]["r" + std::to_string(n)] = {
          {"union", {"r" + std::to_string(n - 1), "r" + std::to_string(n - 1)}}};
    return given.dump();
  };
  EXPECT_EQ(refusal_of(doubled(10)), "");
  EXPECT_TRUE(has(refusal_of(doubled(40)),
                  "/regions/r13/union: expected a set of at most 10000 regions; with all names "
                  "written out it has 16383"));
  Json wide = scene();
  wide["regions"]["r"] = {{"union", Json::array()}};
  for (int n = 0; n < 20'000; ++n) wide["regions"]["r"]["union"].push_back("x_min");
  EXPECT_TRUE(has(refusal_of(wide.dump()), "it has 20001"));
}

TEST(Limits, StagesKeysAndValues) {
  Json many = scene();
  for (int n = 0; n < 5'000; ++n) many["pipeline"].push_back({{"type", "writers.table"}});
  many["pipeline"][4]["name"] = "table_7";
  const auto read_back = read(many.dump());
  EXPECT_EQ(read_back->stages[3].name, "table");
  EXPECT_EQ(read_back->stages[5].name, "table_2");
  EXPECT_EQ(read_back->stages[10].name, "table_8");
  EXPECT_EQ(read_back->stages.back().name, "table_5000");

  while (many["pipeline"].size() <= 10'000) many["pipeline"].push_back({{"type", "writers.table"}});
  EXPECT_TRUE(
      has(refusal_of(many.dump()), "/pipeline: expected at most 10000 stages; there are 10001"));

  std::string keys = "{";
  for (int n = 0; n < 20'000; ++n) keys += "\"k" + std::to_string(n) + "\": 1, ";
  EXPECT_TRUE(has(refusal_of(keys + "\"format\": 1}"), "at most 10000 keys in an object"));

  Json wrong = scene();
  for (int n = 0; n < 5'000; ++n) wrong["key" + std::to_string(n)] = 1;
  const std::string faults = refusal_of(wrong.dump());
  EXPECT_TRUE(has(faults, "... and 4900 faults more"));
  EXPECT_LT(faults.size(), 60'000u);
  EXPECT_TRUE(has(refusal_of(std::string(std::size_t{65} << 20, ' ')), "JSON of at most 64 MB"));
}

TEST(Limits, MessagesAreShort) {
  const std::string huge(200'000, 'x');
  for (const char* pointer :
       {"/title", "/format", "/pipeline/0/type", "/pipeline/0/spacing", "/pipeline/0/shape",
        "/pipeline/1/young", "/regions", "/plugins", "/precision"}) {
    Json given = scene();
    given[Json::json_pointer(pointer)] = huge;
    EXPECT_LT(refusal_of(given.dump()).size(), 3'000u) << pointer;
    given[Json::json_pointer(pointer)] = "1 " + huge;
    EXPECT_LT(refusal_of(given.dump()).size(), 3'000u) << pointer;
    given[Json::json_pointer(pointer)] = {{huge, 1}};
    EXPECT_LT(refusal_of(given.dump()).size(), 3'000u) << pointer;
  }
  EXPECT_LT(refusal_of("{\"" + huge).size(), 3'000u);
  EXPECT_LT(refusal_of("{\"a\": " + huge).size(), 3'000u);
}

TEST(Limits, WhatNobodySeesIsShown) {
  Json given = scene();
  given["title\u00A0"] = 1;
  given["pipeline"][0]["spacing"] = "1 m\u200Bm";
  const std::string why = refusal_of(given.dump());
  EXPECT_TRUE(has(why, "/titleU+00A0")) << why;
  EXPECT_TRUE(has(why, "\"1 mU+200Bm\"")) << why;
}

TEST(Limits, OnlyRegularFilesOfABoundedSizeAreRead) {
  const test::Folder folder("limits");
  const auto reading = [](const std::string& file) {
    return refusal([&] { read_input_file(file, "/file", "a file"); });
  };
  ASSERT_EQ(::mkfifo(folder.file("pipe").c_str(), 0600), 0);
  std::ofstream(folder.file("large")) << "x";
  std::filesystem::resize_file(folder.file("large"),
                               largest_input + 1);  // sparse file
  std::ofstream(folder.file("small")) << "text";
  EXPECT_EQ(reading("/dev/zero"),
            "/file: \"/dev/zero\": expected a file; it is a device or a pipe, and only regular "
            "files are read");
  EXPECT_TRUE(has(reading(folder.file("pipe")), "it is a device or a pipe"));
  EXPECT_TRUE(has(reading(folder.file("large")), "it is larger than 4 GB"));
  EXPECT_TRUE(has(reading(folder.file("")), "it is a folder"));
  EXPECT_TRUE(has(reading(folder.file("none")), "there is no such file"));
  EXPECT_EQ(read_input_file(folder.file("small"), "", ""), "text");
  // Files in /proc are regular files without a size.
  EXPECT_FALSE(read_input_file("/proc/self/status", "", "").empty());

  Json given = scene();
  for (const char* file : {"/dev/zero", "pipe", "large"}) {
    given["pipeline"][0]["shape"] = {
        {"stl", {{"file", std::string(file).front() == '/' ? file : folder.file(file)}}}};
    EXPECT_TRUE(has(refusal_of(given.dump()), "/pipeline/0/shape/stl/file")) << file;
  }
}

TEST(Limits, ASceneFromElsewhereBringsNoPlugins) {
  Json given = scene();
  fakes::Catalogue catalogue;
  catalogue.scene_plugins = false;
  const auto refused = [&] {
    return refusal([&] { read_scene_text(given.dump(), "scene.json", {}, catalogue); });
  };
  EXPECT_EQ(refused(), "");
  given["plugins"] = Json::array();
  EXPECT_EQ(refused(), "");
  given["plugins"].push_back("here");
  EXPECT_EQ(
      refused(),
      "/plugins: [\"here\"]: expected no plugins of the scene's own, since --no-plugins was given");
}

TEST(Limits, EditorsMayNameTheSchema) {
  Json given = scene();
  given["$schema"] = "scene.schema.json";
  EXPECT_EQ(refusal_of(given.dump()), "");
  EXPECT_FALSE(has(read(given.dump())->resolved, "$schema"));
  given["$schema"] = 1;
  EXPECT_TRUE(has(refusal_of(given.dump()), "/$schema: 1: expected"));
}

}  // namespace limits_test
