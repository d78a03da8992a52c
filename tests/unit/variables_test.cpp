// Variables, included files and names of stages in a scene. The components only declare options.
#include "support/fake_components.hpp"
#include "support/output.hpp"

#include <scene/document.hpp>

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include <fstream>

namespace variables_test {
using namespace hyperlattice;

namespace {

/// A scene with these variables; `changes` are `--set` of the command line.
struct Trial {
  std::string variables = "{}";
  std::vector<std::string> changes;
};

const char* const pipeline = R"([
    { "type": "lattices.grid", "spacing": "1 mm", "shape": { "sphere": { "radius": "10 mm" } } },
    { "type": "materials.spring", "young": "10 GPa", "poisson": 0.2, "density": 2500,
      "failure": { "type": "failures.limit", "limit": "1 um" } },
    { "type": "loads.push", "name": "first" },
    { "type": "loads.push", "name": "second" },
    { "type": "solvers.march", "end_time": "40 us" },
    { "type": "writers.table" } ])";

std::unique_ptr<Scene> read(const Trial& trial) {
  static fakes::Catalogue catalogue;  // the scene keeps pointers to its components
  return read_scene_text(R"({ "format": "hyperlattice/1", "variables": )" + trial.variables +
                             R"(, "pipeline": )" + pipeline + "}",
                         "/scenes/scene.json", trial.changes, catalogue);
}

std::string message(const Trial& trial) {
  try {
    read(trial);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

Json resolved(const Trial& trial) { return Json::parse(read(trial)->resolved); }

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST(Variables, StandInArithmetic) {
  const Json scene = resolved({R"({ "r": "50 mm", "inner": "${r} * 0.4", "half": "${inner} / 2" })",
                               {"/pipeline/0/spacing=${half} / 10",
                                "/pipeline/0/shape={\"hollow_sphere\": {\"inner_radius\": "
                                "\"${inner}\", \"outer_radius\": \"${r} + 1 mm\"}}"}});
  EXPECT_EQ(scene["pipeline"][0]["spacing"], 0.05 * 0.4 / 2 / 10);
  EXPECT_EQ(scene["pipeline"][0]["shape"]["hollow_sphere"]["inner_radius"], 0.05 * 0.4);
  EXPECT_EQ(scene["pipeline"][0]["shape"]["hollow_sphere"]["outer_radius"], 0.05 + 0.001);
  EXPECT_FALSE(scene.contains("variables"));
}

TEST(Variables, OneNameStandsForAnyValue) {
  const Json scene = resolved(
      {R"({ "ball": {"sphere": {"radius": "${r}"}}, "r": "3 mm", "yes": true, "where": "x_max",
            "times": [0, "${t} * 2"], "t": "1 us", "n": 3, "push": "loads.push" })",
       {"/pipeline/0/shape=${ball}", "/pipeline/2/follow=${yes}", "/pipeline/2/on=${where}",
        "/pipeline/2/times=${times}", "/pipeline/2/repeats=${n}", "/pipeline/3/repeats=${n} * 2",
        "/pipeline/3/type=${push}"}});
  EXPECT_EQ(scene["pipeline"][0]["shape"]["sphere"]["radius"], 0.003);
  EXPECT_EQ(scene["pipeline"][2]["follow"], true);
  EXPECT_EQ(scene["pipeline"][2]["on"], "x_max");
  EXPECT_EQ(scene["pipeline"][2]["times"], Json::parse("[0.0, 2e-6]"));
  EXPECT_EQ(scene["pipeline"][2]["repeats"], 3);
  EXPECT_EQ(scene["pipeline"][3]["repeats"], 6);
}

TEST(Variables, FillTheGapsOfTexts) {
  const Json scene = resolved({R"({ "r": "50 mm", "half": "${r} / 2", "n": 2, "b": "cells" })",
                               {"/title=Radius ${r}, ${half}, ${n}", "/pipeline/0/boundary=${b}",
                                "/pipeline/5/fields=[\"${f}\"]", "/variables/f=velocity"}});
  EXPECT_EQ(scene["title"], "Radius 50 mm, 0.025 m, 2");
  EXPECT_EQ(scene["pipeline"][0]["boundary"], "cells");
  EXPECT_EQ(scene["pipeline"][5]["fields"], Json::parse("[\"velocity\"]"));
}

TEST(Variables, ChangeByTheCommandLine) {
  const Trial trial{R"({ "r": "50 mm" })",
                    {"/variables/r=60 mm", "/pipeline/0/spacing=${r} / 100"}};
  EXPECT_EQ(resolved(trial)["pipeline"][0]["spacing"], 0.06 / 100);
  EXPECT_EQ(read(trial)->variables.at("r"), 0.06);
}

TEST(Variables, TheResolvedSceneIsTheSameScene) {
  fakes::Catalogue catalogue;
  const auto scene = read({R"({ "e": "10 GPa", "p": "0.1 + 0.1" })",
                           {"/pipeline/1/young=${e} * 0.7", "/pipeline/1/poisson=${p} * 0.3"}});
  EXPECT_EQ(read_scene_text(scene->resolved, "/scenes/scene.json", {}, catalogue)->resolved,
            scene->resolved);
}

TEST(Variables, DimensionsAreChecked) {
  EXPECT_PRED2(
      says,
      message({R"({ "r": "1 mm", "t": "1 s", "x": "${r} + ${t}" })", {"/pipeline/0/spacing=${x}"}}),
      "/variables/x: \"${r} + ${t}\": expected arithmetic of quantities; \"+\" stands "
      "between a length and a time");
  EXPECT_PRED2(says, message({R"({ "t": "1 s" })", {"/pipeline/0/spacing=${t} * 2"}}),
               "/pipeline/0/spacing: \"${t} * 2\": expected a length above 0 m such as \"1 mm\" "
               "(it is a time)");
  EXPECT_PRED2(says, message({R"({ "n": 2 })", {"/pipeline/0/spacing=${n} * 2"}}),
               "(it is a number; give its variables units)");
  EXPECT_PRED2(says, message({R"({ "n": 2.5 })", {"/pipeline/2/repeats=${n} * 3"}}), "an integer");
}

TEST(Variables, WrongNamesAndCirclesAreFaults) {
  EXPECT_PRED2(says, message({R"({ "radius": "1 mm" })", {"/pipeline/0/spacing=${raduis}"}}),
               "/pipeline/0/spacing: \"${raduis}\": expected a known variable; there is no "
               "\"raduis\"; did you mean \"radius\"?");
  EXPECT_PRED2(says, message({"{}", {"/title=${a}"}}), "the scene has none, and no \"a\"");
  EXPECT_PRED2(says,
               message({R"({ "a": "${b}", "b": "2 * ${c}", "c": ["${a}"] })", {"/title=${a}"}}),
               "expected a value that does not lead back to itself (a -> b -> c -> a)");
  EXPECT_PRED2(says, message({R"({ "a": "${a}" })", {"/title=${a}"}}), "(a -> a)");
  EXPECT_PRED2(says, message({R"({ "1a": 1 })", {"/title=${1a}"}}),
               "/variables/1a: 1: expected a name");
  EXPECT_PRED2(says, message({"[1]", {}}), "/variables: [1]: expected an object");
  EXPECT_PRED2(says, message({R"({ "a": [1] })", {"/title=x ${a}"}}), "cannot stand in a text");
  EXPECT_PRED2(says, message({R"({ "a": "I-m" })", {"/pipeline/0/spacing=${a} * 2"}}),
               "\"a\" is \"I-m\", and no quantity");
  EXPECT_PRED2(says, message({R"({ "a": 1 })", {"/pipeline/0/spacing=${a"}}), "has no \"}\"");
  // one fault alone, although two strings use the faulty variable
  EXPECT_EQ(message({R"({ "a": "1 + ${b}" })",
                     {"/pipeline/0/spacing=${a}", "/pipeline/1/young=2 * ${a}"}}),
            "/variables/a: \"1 + ${b}\": expected a known variable; there is no \"b\"");
}

TEST(Variables, DoNotGrowBeyondBounds) {
  std::string doubled = R"({ "v0": [1, 2])", chain = R"({ "v0": 1)";
  for (int n = 1; n < 60; ++n) {
    const std::string before = "\"${v" + std::to_string(n - 1) + "}\"",
                      name = ", \"v" + std::to_string(n) + "\": ";
    doubled += name + "[" + before + ", " + before + "]";
  }
  for (int n = 1; n < 5000; ++n)
    chain += ", \"v" + std::to_string(n) + "\": \"${v" + std::to_string(n + 1) + "}\"";
  chain += R"(, "v5000": 1)";
  EXPECT_PRED2(says, message({doubled + "}", {"/title=x ${v59}"}}),
               "expected at most 1000000 values from variables");
  EXPECT_PRED2(says, message({chain + "}", {"/title=x ${v1}"}}),
               "expected at most 64 levels of variables within variables");
  const std::string long_text = "{ \"a\": \"" + std::string(1000, 'x') + "\" }";
  std::string many = "/title=x";
  for (int n = 0; n < 2000; ++n) many += "${a}";
  EXPECT_PRED2(says, message({long_text, {many}}), "the text is longer than");
}

TEST(Variables, UnusedOnesAreNoticed) {
  EXPECT_EQ(read({R"({ "a": 1, "b": "${a}" })", {}})->warnings,
            (std::vector<std::string>{"/variables/a: nothing uses this variable",
                                      "/variables/b: nothing uses this variable"}));
  EXPECT_EQ(read({R"({ "a": 1, "b": "${a}" })", {"/title=x ${b}"}})->warnings.size(), 0u);
  EXPECT_PRED2(says,
               message({R"({ "radius": "1 mm" })",
                        {"/variables/raduis=2 mm", "/pipeline/0/spacing=${radius}"}}),
               "/variables/raduis: \"2 mm\": expected a variable that the scene uses; did you mean "
               "\"radius\"?");
}

TEST(StageNames, FindAStageByNameOrType) {
  const Json scene =
      resolved({"{}",
                {"first/repeats=7", "solvers.march/end_time=1 ms", "failures.limit/limit=3 um",
                 "materials.spring/failure/limit=4 um"}});
  EXPECT_EQ(scene["pipeline"][2]["repeats"], 7);
  EXPECT_EQ(scene["pipeline"][3]["repeats"], 1);
  EXPECT_EQ(scene["pipeline"][4]["end_time"], 0.001);
  EXPECT_EQ(scene["pipeline"][1]["failure"]["limit"], 4e-6);
}

TEST(StageNames, NameTheCandidates) {
  EXPECT_EQ(message({"{}", {"loads.push/repeats=2"}}),
            "--set loads.push/repeats: expected the name or type of one stage; \"loads.push\" may "
            "be /pipeline/2 (first, loads.push), /pipeline/3 (second, loads.push)");
  EXPECT_PRED2(says, message({"{}", {"frist/repeats=2"}}), "did you mean \"first\"?");
  EXPECT_PRED2(says, message({"{}", {"probes/repeats=2"}}),
               "there are lattices.grid, materials.spring, failures.limit, first, second, "
               "solvers.march, writers.table");
  EXPECT_PRED2(says, message({"{}", {"first=2"}}), "or name/option=value");
  EXPECT_PRED2(says, message({"{}", {"first/repaets=2"}}), "did you mean \"repeats\"?");
}

class Include : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) {
    std::filesystem::create_directories(std::filesystem::path(folder_.file(name)).parent_path());
    std::ofstream(folder_.file(name)) << text;
  }
  std::unique_ptr<Scene> read(const std::string& text, std::vector<std::string> changes = {}) {
    write("scene.json", text);
    return read_scene_text(text, folder_.file("scene.json"), changes, catalogue_);
  }
  std::string message(const std::string& text) {
    try {
      read(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  test::Folder folder_{"include"};
  fakes::Catalogue catalogue_;
  const std::string body_ =
      R"("format": "hyperlattice/1", "pipeline": [
    { "type": "lattices.grid", "spacing": "${h}", "shape": { "sphere": { "radius": "10 mm" } } },
    { "type": "materials.spring", "young": "10 GPa", "poisson": 0.2, "density": 2500 } ])";
};

TEST_F(Include, ObjectsMergeAndStagesComeFirst) {
  write("parts/body.json", "{" + body_ + R"(, "title": "body", "include": "sizes.json" })");
  write("parts/sizes.json", R"({ "variables": { "h": "1 mm", "t": "2 us" },
                                 "regions": { "a": "x_min", "b": "x_max" } })");
  const auto scene =
      read(R"({ "$schema": "scene.schema.json", "include": ["parts/body.json", "parts/sizes.json"],
      "variables": { "h": "2 mm" }, "regions": { "b": "y_max" },
      "pipeline": [ { "type": "solvers.march", "end_time": "${t}" } ] })");
  const Json json = Json::parse(scene->resolved);
  EXPECT_EQ(json["title"], "body");
  EXPECT_EQ(json["pipeline"][0]["spacing"], 0.002);
  EXPECT_EQ(json["pipeline"][2]["end_time"], 2e-6);
  EXPECT_EQ(json["pipeline"].size(), 3u);
  EXPECT_EQ(json["regions"], Json::parse(R"({"a": "x_min", "b": "y_max"})"));
  EXPECT_FALSE(json.contains("include"));
  EXPECT_TRUE(scene->warnings.empty());
}

TEST_F(Include, FaultsNameTheFile) {
  write("body.json", "{" + body_ + R"(, "variables": { "h": "1 mm", "unused": 1 } })");
  EXPECT_EQ(
      message(R"({ "include": "body.json", "titel": "x", "variables": { "h": "-1 mm" },
      "pipeline": [ { "type": "solvers.march", "end_time": "1 m" } ] })"),
      "body.json:/pipeline/0/spacing: \"-1 mm\": expected a length above 0 m such as \"1 mm\"\n"
      "scene.json:/pipeline/0/end_time: \"1 m\": expected a time above 0 s such as \"1 us\" "
      "(it is a length)\n"
      "scene.json:/titel: \"x\": expected a known key; did you mean \"title\"?");
}

TEST_F(Include, WrongFilesAreFaults) {
  write("a.json", R"({ "include": ["b.json"] })");
  write("b.json", R"({ "include": "a.json" })");
  write("twice.json", R"({ "title": "x", "title": "y" })");
  write("broken.json", "{ \"title\": ");
  write("list.json", "[]");
  EXPECT_EQ(message(R"({ "include": ["a.json"] })"),
            "b.json:/include: \"a.json\": expected a file that does not include itself (a.json -> "
            "b.json -> a.json)");
  EXPECT_PRED2(says, message(R"({ "include": "scene.json" })"), "(scene.json -> scene.json)");
  EXPECT_PRED2(
      says, message(R"({ "include": ["no.json", 7] })"),
      "/no.json\": expected the name of a file, relative to the file that names it; there is no "
      "such file");
  EXPECT_PRED2(says, message(R"({ "include": ["no.json", 7] })"),
               "scene.json:/include/1: 7: expected the name of a file");
  EXPECT_PRED2(says, message(R"({ "include": {} })"), "scene.json:/include: {}: expected");
  EXPECT_PRED2(says, message(R"({ "include": "twice.json" })"),
               "twice.json:/title: expected the key \"title\" only once");
  EXPECT_PRED2(says, message(R"({ "include": "broken.json" })"), "broken.json:line 1, column");
  EXPECT_PRED2(says, message(R"({ "include": "list.json" })"),
               "list.json:: []: expected an object");
}

TEST_F(Include, SettingsChangeTheMergedScene) {
  write("body.json", "{" + body_ + R"(, "variables": { "h": "1 mm" } })");
  const std::string scene =
      R"({ "include": "body.json", "pipeline": [ { "type": "solvers.march", "end_time": "1 us" } ] })";
  const auto changed = read(scene, {"/variables/h=4 mm", "solvers.march/end_time=3 us"});
  EXPECT_EQ(Json::parse(changed->resolved)["pipeline"][0]["spacing"], 0.004);
  EXPECT_EQ(Json::parse(changed->resolved)["pipeline"][2]["end_time"], 3e-6);
  EXPECT_THROW(read(scene, {"/include=other.json"}), InputError);
}

}  // namespace variables_test
