// Whole scenes: defaults, labels, the resolved scene, and rules of order. The components only
// declare options.
#include "support/fake_components.hpp"
#include "support/output.hpp"

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <filesystem>
#include <fstream>

namespace scene_test {
using namespace hyperlattice;
using Json = nlohmann::ordered_json;

namespace {

const char* const good = R"({
  "format": "hyperlattice/1",
  "title": "All kinds", // a comment
  "regions": { "tip": { "box": { "low": [0, 0, "9 mm"], "high": ["10 mm", "10 mm", "10 mm"] } },
               "body": { "difference": [ { "sphere": { "radius": "10 mm" } }, "tip" ] } },
  "pipeline": [
    { "type": "lattices.grid", "spacing": "1 mm", "shape": "body" },
    { "type": "materials.spring", "young": "10 GPa", "poisson": "20 %", "density": 2500,
      "failure": { "type": "failures.limit", "limit": "3.5e-3 mm" } },
    { "type": "materials.spring", "young": "1 GPa", "poisson": 0.1, "density": "2.5 g/cm3", "law": "cubic", "region": "tip" },
    { "type": "loads.push", "times": [0, "2 us"], "on": { "intersection": ["x_max", "tip"] } },
    { "type": "solvers.march", "end_time": "40 us" },
    { "type": "solvers.march", "end_time": "80 us", "time_step": "10 ns", "record_every": "1 us", "energy_tolerance": 0 },
    { "type": "writers.table", "every": "2 us", "last": false, "fields": ["velocity", "damage"] },
    { "type": "writers.table", "name": "second" },
    { "type": "probes.spot", "point": [0, 0, "5 mm"] } ] })";

std::unique_ptr<Scene> read(std::string_view text, const std::vector<std::string>& settings = {}) {
  static fakes::Catalogue catalogue;  // the scene keeps pointers to its components
  return read_scene_text(text, "/scenes/scene.json", settings, catalogue);
}

std::vector<Fault> faults(std::string_view text, const std::vector<std::string>& settings = {}) {
  try {
    read(text, settings);
  } catch (const InputError& error) {
    return error.faults();
  }
  return {};
}

std::string messages(const std::vector<Fault>& faults) {
  return faults.empty() ? "" : InputError(faults).what();
}

template <class Declared>
const typename Declared::Options& options(const Stage& stage) {
  return *static_cast<const typename Declared::Options*>(stage.options.get());
}

}  // namespace

TEST(Scene, ValuesAreInSiAndDefaultsAreFilled) {
  const auto scene = read(good);
  EXPECT_EQ(scene->title, "All kinds");
  ASSERT_EQ(scene->stages.size(), 9u);
  const auto& grid = options<fakes::Grid>(scene->stages[0]);
  EXPECT_EQ(grid.spacing, 0.001);
  EXPECT_EQ(grid.boundary, "particles");
  EXPECT_FALSE(grid.anchor);
  EXPECT_TRUE(grid.shape->contains({0, 0, -0.0099}));
  EXPECT_FALSE(grid.shape->contains({0.001, 0.001, 0.0095}));  // the tip is cut off
  const auto& spring = options<fakes::Spring>(scene->stages[1]);
  EXPECT_EQ(spring.young, 1e10);
  EXPECT_EQ(spring.poisson, 0.2);
  EXPECT_EQ(options<fakes::Spring>(scene->stages[2]).density, 2500);
  EXPECT_EQ(options<fakes::Spring>(scene->stages[2]).law, fakes::Spring::Law::cubic);
  EXPECT_EQ(options<fakes::Limit>(scene->stages[1].failures.at(0)).limit, 3.5e-6);
  const auto& push = options<fakes::Push>(scene->stages[3]);
  EXPECT_EQ(push.force, (Vec3{0, 0, 1000}));
  EXPECT_EQ(push.times, (std::vector<double>{0, 2e-6}));
  EXPECT_EQ(push.repeats, 1);
  EXPECT_EQ(scene->regions[push.on].kind, Region::Kind::intersection);
  EXPECT_FALSE(options<fakes::March>(scene->stages[4]).time_step);
  EXPECT_EQ(options<fakes::March>(scene->stages[5]).time_step, 1e-8);
  EXPECT_EQ(options<fakes::Table>(scene->stages[6]).fields,
            (std::vector<std::string>{"velocity", "damage"}));
  EXPECT_EQ(options<fakes::Spot>(scene->stages[8]).point, (Vec3{0, 0, 0.005}));
}

TEST(Scene, CommonKeysReachTheStage) {
  const auto scene = read(good);
  EXPECT_EQ(scene->regions.name(scene->stages[1].region), "all");
  EXPECT_EQ(scene->regions.name(scene->stages[2].region), "tip");
  EXPECT_EQ(scene->stages[4].record_every, 0);
  EXPECT_EQ(scene->stages[4].energy_tolerance, 0.05);
  EXPECT_EQ(scene->stages[5].record_every, 1e-6);
  EXPECT_EQ(scene->stages[5].energy_tolerance, 0);
  EXPECT_EQ(scene->stages[6].cadence.every, 2e-6);
  EXPECT_FALSE(scene->stages[6].cadence.last);
  EXPECT_FALSE(scene->stages[7].cadence.every);
  EXPECT_TRUE(scene->stages[7].cadence.last);
  EXPECT_EQ(scene->of(Family::solvers).size(), 2u);
}

TEST(Scene, LabelsAreUniqueInTheirFamily) {
  const auto scene = read(good);
  std::vector<std::string> names;
  for (const Stage& stage : scene->stages) names.push_back(stage.name);
  EXPECT_EQ(names, (std::vector<std::string>{"grid", "spring", "spring_2", "push", "march",
                                             "march_2", "table", "second", "spot"}));
  EXPECT_NE(
      messages(faults(good, {"/pipeline/6/name=second"}))
          .find("/pipeline/7/name: \"second\": expected a label of its own among the writers"),
      std::string::npos);
  EXPECT_EQ(read(good, {"/pipeline/7/name=table"})->stages[6].name, "table_2");
}

TEST(Scene, ResolvedReadsBackAsItself) {
  const auto scene = read(good);
  const auto again = read(scene->resolved);
  EXPECT_EQ(again->resolved, scene->resolved);
  const Json json = Json::parse(scene->resolved);
  EXPECT_EQ(json["pipeline"][0]["spacing"], 0.001);
  EXPECT_EQ(json["pipeline"][0]["anchor"], "auto");
  EXPECT_EQ(json["pipeline"][1]["failure"]["limit"], 3.5e-6);
  EXPECT_EQ(json["regions"]["tip"]["box"]["high"][2], 0.01);
  EXPECT_EQ(json["regions"]["body"]["difference"][1], "tip");
  EXPECT_EQ(json["pipeline"][3]["on"]["intersection"][0], "x_max");
}

TEST(Scene, AMaterialHasAListOfFailureCriteria) {
  const auto with = [](Json failure) {
    Json json = Json::parse(good, nullptr, true, true);
    json["pipeline"][1]["failure"] = std::move(failure);
    return json.dump();
  };
  const Json one{{"type", "failures.limit"}, {"limit", "2 um"}},
      other{{"type", "failures.limit"}, {"limit", "3 um"}};
  const auto scene = read(with({one, other})), again = read(scene->resolved);
  for (const Scene* read_one : {scene.get(), again.get()}) {
    const std::vector<Stage>& failures = read_one->stages[1].failures;
    ASSERT_EQ(failures.size(), 2u);
    EXPECT_EQ(options<fakes::Limit>(failures[0]).limit, 2e-6);
    EXPECT_EQ(options<fakes::Limit>(failures[1]).limit, 3e-6);
    EXPECT_EQ(failures[1].pointer, "/pipeline/1/failure/1");
  }
  EXPECT_EQ(again->resolved, scene->resolved);
  EXPECT_EQ(read(good)->stages[1].failures.at(0).pointer, "/pipeline/1/failure");
  EXPECT_EQ(read(with(Json::array({one})))->stages[1].failures.at(0).pointer,
            "/pipeline/1/failure/0");

  EXPECT_NE(messages(faults(with(Json::array())))
                .find("/pipeline/1/failure: []: expected at least one criterion"),
            std::string::npos);
  const std::string wrong = messages(faults(with({one,
                                                  "failures.limit",
                                                  {{"type", "failures.limit"}, {"limit", -1}},
                                                  {{"type", "loads.push"}},
                                                  Json::array({one})})));
  for (const char* at :
       {"/pipeline/1/failure/1: \"failures.limit\": expected an object with a type",
        "/pipeline/1/failure/2/limit: -1",
        "/pipeline/1/failure/3/type: \"loads.push\": expected a type of the family",
        "/pipeline/1/failure/4: "})
    EXPECT_NE(wrong.find(at), std::string::npos) << at << "\n" << wrong;
}

TEST(Scene, ResolvedKeepsEveryBitOfEveryNumber) {
  const bool good_for_all = rc::check([] {
    const auto positive = [] {
      return std::ldexp(
          1 + static_cast<double>(*rc::gen::inRange<std::int64_t>(0, 1LL << 52)) * 0x1p-52,
          *rc::gen::inRange(-300, 300));
    };
    Json json = Json::parse(good, nullptr, true, true);
    const double young = positive(), limit = positive(), end = positive(), x = positive(),
                 radius = positive();
    json["pipeline"][1]["young"] = young;
    json["pipeline"][1]["failure"]["limit"] = limit;
    json["pipeline"][4]["end_time"] = end;
    json["pipeline"][8]["point"] = {x, -x, 0};
    json["pipeline"][0]["shape"] = {{"sphere", {{"radius", radius}}}};
    const auto scene = read(json.dump()), again = read(scene->resolved);
    RC_ASSERT(again->resolved == scene->resolved);
    for (const Scene* one : {scene.get(), again.get()}) {
      RC_ASSERT(options<fakes::Spring>(one->stages[1]).young == young);
      RC_ASSERT(options<fakes::Limit>(one->stages[1].failures.at(0)).limit == limit);
      RC_ASSERT(options<fakes::March>(one->stages[4]).end_time == end);
      RC_ASSERT((options<fakes::Spot>(one->stages[8]).point == Vec3{x, -x, 0}));
      RC_ASSERT(options<fakes::Grid>(one->stages[0]).shape->high.z == radius);
    }
  });
  EXPECT_TRUE(good_for_all);
}

TEST(Scene, AllFaultsAreReportedAtOnce) {
  const auto found = faults(
      good, {"/pipeline/0/spacing=5 s", "/pipeline/1/failure/limit=-1", "/pipeline/3/repeats=3.7",
             "/pipeline/4/time_step=automatic", "/pipeline/6/fields=[\"velocty\"]", "/titel=x",
             "/pipeline/2/region=tipp", "/nowhere/else=1"});
  std::vector<std::string> pointers;
  for (const Fault& fault : found) pointers.push_back(fault.pointer);
  EXPECT_EQ(pointers, (std::vector<std::string>{"--set /nowhere/else", "/pipeline/0/spacing",
                                                "/pipeline/1/failure/limit", "/pipeline/2/region",
                                                "/pipeline/3/repeats", "/pipeline/4/time_step",
                                                "/pipeline/6/fields/0", "/titel"}))
      << messages(found);
}

TEST(Scene, OrderOfThePipeline) {
  const auto order = [](std::vector<int> stages) {
    Json json = Json::parse(good, nullptr, true, true), pipeline = Json::array();
    for (const int n : stages) pipeline.push_back(json["pipeline"][static_cast<std::size_t>(n)]);
    json["pipeline"] = pipeline;
    return messages(faults(json.dump()));
  };
  EXPECT_EQ(order({0, 1, 4}), "");
  EXPECT_EQ(order({0, 4, 8, 1}), "");
  EXPECT_EQ(order({1, 0, 4}),
            "/pipeline/1: expected the lattice as the first stage of the pipeline");
  EXPECT_EQ(order({0, 1, 0, 4}), "/pipeline/2: expected no second lattice");
  EXPECT_EQ(order({1, 4}), "/pipeline/0: expected a lattice as the first stage of the pipeline");
  EXPECT_EQ(order({0, 4}), "/pipeline: expected at least one material");
  EXPECT_EQ(order({0, 1}), "/pipeline: expected at least one solver");
  EXPECT_EQ(order({0}),
            "/pipeline: expected at least one material\n/pipeline: expected at least one solver");
}

TEST(Scene, CrossChecksSeeTheFilledOptions) {
  const auto found = faults(good, {"/pipeline/2/poisson=-0.1"});
  ASSERT_EQ(found.size(), 1u) << messages(found);
  EXPECT_EQ(found[0].pointer, "/pipeline/2/poisson");
  EXPECT_EQ(found[0].value, "-0.1");
  EXPECT_EQ(found[0].expected, "no negative ratio with the cubic law");
}

namespace {

/// Returns the good scene with an option of a stage under another name.
std::string renamed(std::size_t stage, const char* name, const char* other) {
  Json scene = Json::parse(good, nullptr, true, true);
  Json& options = scene["pipeline"][stage];
  options[other] = options[name];
  options.erase(name);
  return scene.dump();
}

}  // namespace

TEST(Scene, AFormerNameOfAnOptionIsAcceptedWithAWarning) {
  EXPECT_TRUE(read(good)->warnings.empty());
  const auto scene = read(renamed(4, "end_time", "until"));
  EXPECT_EQ(scene->warnings,
            (std::vector<std::string>{"/pipeline/4/until: \"until\" is named \"end_time\" since "
                                      "version 0.8; the old name will go"}));
  EXPECT_EQ(options<fakes::March>(scene->stages[4]).end_time, 40e-6);
  EXPECT_EQ(scene->resolved, read(good)->resolved);
  EXPECT_TRUE(read(scene->resolved)->warnings.empty());
}

TEST(Scene, FaultsNameAnOptionAsTheSceneDoes) {
  EXPECT_EQ(messages(faults(renamed(4, "end_time", "until"), {"/pipeline/4/until=0"})),
            "/pipeline/4/until: 0: expected a time above 0 s such as \"1 us\"");
  EXPECT_EQ(messages(faults(renamed(2, "poisson", "nu"), {"/pipeline/2/nu=-0.1"})),
            "/pipeline/2/nu: -0.1: expected no negative ratio with the cubic law");
}

TEST(Scene, AnOptionHasOneNameAtATime) {
  EXPECT_EQ(messages(faults(good, {"/pipeline/4/until=1 us"})),
            "/pipeline/4/until: \"1 us\": expected \"end_time\" alone; \"until\" is its name "
            "before version 0.8");
  EXPECT_EQ(messages(faults(renamed(4, "end_time", "until"), {"/pipeline/4/duration=1 us"})),
            "/pipeline/4/duration: \"1 us\": expected \"until\" alone; \"duration\" is its name "
            "before version 0.9");
}

TEST(Scene, WhoMisspellsAFormerNameIsToldThePresentOne) {
  EXPECT_EQ(messages(faults(good, {"/pipeline/4/durations=1 us"})),
            "/pipeline/4/durations: \"1 us\": expected a known key; did you mean \"end_time\"?");
}

TEST(Scene, AFormerNameIsNoKeyOfTheCore) {
  struct Clash {
    struct Options {
      double every_step = 0;
    };
    static Schema<Options> schema() {
      return Schema<Options>("probes.clash", "Has had a name of the core's")
          .add<&Options::every_step>("every_step", "", "of no effect")
          .formerly("every", "0.9");
    }
  };
  fakes::Catalogue catalogue;
  catalogue.add<Clash>(Family::probes);
  Json json = Json::parse(good, nullptr, true, true);
  json["pipeline"].push_back({{"type", "probes.clash"}, {"every_step", 1}});
  try {
    read_scene_text(json.dump(), "/scenes/scene.json", {}, catalogue);
    FAIL();
  } catch (const OutsideError& error) {
    EXPECT_STREQ(
        error.what(),
        "/pipeline/9/type: probes.clash declares the option \"every\", a key of the core's "
        "own");
  }
}

TEST(Scene, FilesStandUnderPresentNames) {
  const test::Folder here("former_names");
  std::ofstream(here.file("image.raw")) << "\1";
  Json json = Json::parse(good, nullptr, true, true);
  Json& grid = json["pipeline"][0];
  grid.erase("shape");
  grid["solid"] = {{"voxels", {{"file", "image.raw"}, {"counts", {1, 1, 1}}, {"voxel", "1 mm"}}}};
  fakes::Catalogue catalogue;
  const auto scene = read_scene_text(json.dump(), here.file("scene.json"), {}, catalogue);
  ASSERT_EQ(scene->files.size(), 1u);
  EXPECT_EQ(scene->files[0].pointer, "/pipeline/0/shape/voxels/file");
  const Json moved = Json::parse(scene->resolved_in(here.file("results")));
  EXPECT_EQ(moved["pipeline"][0]["shape"]["voxels"]["file"], "../image.raw");
}

TEST(Scene, ARefusedLibraryIsTheOutsidesFailure) {
  fakes::Catalogue catalogue;
  catalogue.refused_type = "loads.bad";
  const std::string scene = R"({"format": "hyperlattice/1", "pipeline": [
    {"type": "lattices.grid", "spacing": 1, "shape": {"sphere": {"radius": 5}}}, {"type": "materials.spring", "young": 1, "poisson": 0, "density": 1},
    {"type": "loads.bad"}, {"type": "solvers.march", "end_time": 1}]})";
  try {
    read_scene_text(scene, "scene.json", {}, catalogue);
    FAIL();
  } catch (const OutsideError& error) {
    EXPECT_STREQ(error.what(), "/pipeline/2/type: wrong interface version");
  }
  // If the input is wrong as well, the error lists the faults of the input first, and the refused
  // plugin too.
  EXPECT_THROW(
      {
        try {
          read_scene_text(scene, "scene.json", {"/pipeline/0/spacing=-1"}, catalogue);
        } catch (const InputError& error) {
          EXPECT_NE(std::string(error.what()).find("wrong interface version"), std::string::npos);
          throw;
        }
      },
      InputError);
}

TEST(Scene, PluginPathsBecomeAbsolute) {
  fakes::Catalogue catalogue;
  const std::string folder = HYPERLATTICE_SOURCE;
  const auto scene =
      read_scene_text(good, folder + "/tests/scene.json", {"/plugins=[\"../core\"]"}, catalogue);
  EXPECT_EQ(Json::parse(scene->resolved)["plugins"][0], folder + "/core");
  EXPECT_THROW(
      read_scene_text(good, folder + "/tests/scene.json", {"/plugins=[\"../cor\"]"}, catalogue),
      InputError);
}

TEST(Scene, PathsAreInUtf8) {
  const test::Folder here("paths_in_utf8");
  const std::string folder = here.file("W\xF6rth");
  std::filesystem::create_directory(folder);
  std::ofstream(folder + "/body.stl") << "solid";
  const auto fault_of = [&](const std::string& setting) {
    fakes::Catalogue catalogue;
    try {
      read_scene_text(good, folder + "/scene.json", {setting}, catalogue);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(fault_of("/title=plain"), "");  // the path of the scene need not be in UTF-8
  for (const char* const setting :
       {"/plugins=[\".\"]", "/regions/tip={\"stl\": {\"file\": \"body.stl\"}}"})
    EXPECT_NE(fault_of(setting).find("a path in UTF-8, and not " + folder), std::string::npos)
        << fault_of(setting);
}

TEST(Scene, AMissingFileIsTheInputsFault) {
  Host host;
  EXPECT_THROW(read_scene("/no/such/scene.json", {}, host), InputError);
  EXPECT_THROW(read_scene(HYPERLATTICE_SOURCE, {}, host), InputError);  // a folder is no scene
}
}  // namespace scene_test
