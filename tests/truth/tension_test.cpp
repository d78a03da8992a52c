// A tension test as an engineer sets it up: a bar between grips, load cells at a grip and at a
// section, a gauge between the ends. The real program runs it.
#include <base/csv.hpp>
#include <support/program.hpp>
#include <support/scene_builder.hpp>

#include <gtest/gtest.h>

namespace tension_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

/// Pulls a bar of 4 x 4 x 10 mm without friction; `on`: what the load cell is on.
nlohmann::json tension(const Json& on, const Keys& solver) {
  const auto text =
      SceneBuilder{}
          .lattice("lattices.cubic", 1e-3, box_mm(4, 4, 10), {{"boundary", "cells"}})
          .material("materials.elastic", {{"young", 1e10}, {"density", 2500}, {"poisson", 0.25}})
          .load("loads.fixed", {{"on", "x_min"}, {"axes", "x"}, {"name", "left"}})
          .load("loads.fixed", {{"on", "y_min"}, {"axes", "y"}})
          .load("loads.fixed", {{"on", "z_min"}, {"axes", "z"}, {"name", "foot"}})
          .load("loads.displacement", {{"on", "z_max"},
                                       {"axes", "z"},
                                       {"value", Vec3{0, 0, 1e-8}},
                                       {"rise", 1e-3},
                                       {"name", "pull"}})
          .stages(Keys{{"type", "solvers.static"}} + solver)
          .stage("probes.reaction", {{"on", on},
                                     {"area", 16e-6},
                                     {"normal", Vec3{0, 0, 1}},
                                     {"name", "grip"},
                                     {"every", 1e-4}})
          .stage("probes.section", {{"point", {0, 0, 4.5e-3}},
                                    {"normal", Vec3{0, 0, 2}},
                                    {"name", "middle"},
                                    {"every", 1e-4}})
          .stage("probes.gauge", {{"from", "z_min"}, {"to", "z_max"}, {"every", 1e-4}})
          .text();
  return nlohmann::json::parse(text);
}

const Keys statics{{"end_time", 1e-3}, {"load_steps", 5}, {"tolerance", 1e-10}};

class Tension : public testing::Test {
 protected:
  Result run(const nlohmann::json& scene) {
    return run_program({"run", write_scene(folder_, scene), "--out", out_, "--quiet"});
  }
  /// Returns a column of a table in the folder.
  std::vector<double> column(const std::string& file, const std::string& name) const {
    const CsvTable table = parse_csv(contents(out_ + "/" + file));
    std::vector<double> values;
    const auto c = table.column(name);
    EXPECT_TRUE(c) << file << " has no " << name;
    for (const auto& row : table.rows)
      if (c) values.push_back(csv_number(row[*c]).value_or(0));
    return values;
  }

  Folder folder_{"tension"};
  std::string out_ = folder_.file("out");
};

TEST_F(Tension, GivesYoungsModulus) {
  for (const Json& on : {Json("pull"), Json("z_max")}) {
    const Result result = run(tension(on, statics));
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto strain = column("probes/gauge.csv", "strain"),
               grip = column("probes/grip.csv", "stress"),
               middle = column("probes/middle.csv", "stress");
    ASSERT_GE(strain.size(), 5u);
    ASSERT_EQ(strain.size(), grip.size());
    ASSERT_EQ(strain.size(), middle.size());
    EXPECT_NEAR(strain.back(), 1e-6, 1e-17);
    EXPECT_NEAR(column("probes/middle.csv", "area").back(), 16e-6, 1e-17);
    for (std::size_t n = 0; n < strain.size(); ++n) {
      EXPECT_NEAR(grip[n], 1e10 * strain[n], 1e-5 * 1e4) << n;
      EXPECT_NEAR(middle[n], grip[n], 1e-7 * 1e4) << n;
    }
    // Moment about the middle of the grip.
    EXPECT_NEAR(column("probes/grip.csv", "moment_x").back(), 0, 1e-9 * 0.16);
    const auto work = column("history.csv", "work_pull"),
               injected = column("history.csv", "injected");
    EXPECT_NEAR(work.back(), 0.5 * 0.16 * 1e-8, 1e-5 * 0.8e-9);
    EXPECT_NEAR(work.back(), injected.back(), 1e-22);
    for (const char* name : {"work_left", "work_fixed", "work_foot"})
      EXPECT_EQ(column("history.csv", name).back(), 0) << name;  // also at edges that `pull` moves
    const Result report = run_program({"report", out_});
    ASSERT_EQ(report.exit_code, 0) << report.err;
    EXPECT_NE(contents(out_ + "/report.html").find("Stress over strain"), std::string::npos);
  }
}

TEST_F(Tension, NamesWhatItDoesNotKnow) {
  const Result unknown = run(tension("pul", statics));
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.err.find("/pipeline/7/on"), std::string::npos) << unknown.err;
  EXPECT_NE(unknown.err.find("the name of a load"), std::string::npos) << unknown.err;
  EXPECT_NE(unknown.err.find("did you mean \"pull\""), std::string::npos) << unknown.err;
  nlohmann::json outside = tension("pull", statics);
  outside["pipeline"][8]["point"] = {0, 0, 1};
  const Result none = run(outside);
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_NE(none.err.find("/pipeline/8/point: [0.0,0.0,1.0]: expected point of a plane that cuts"),
            std::string::npos)
      << none.err;
  nlohmann::json zero = tension("pull", statics);
  zero["pipeline"][7]["normal"] = {0, 0, 0};
  zero["pipeline"][7]["area"] = -1;
  const Result both = run(zero);  // one fault each, though the options are checked one by one
  EXPECT_NE(both.err.find("/pipeline/7/area"), std::string::npos) << both.err;
  EXPECT_NE(both.err.find("/pipeline/7/normal: [0,0,0]: expected a vector that is not zero"),
            std::string::npos)
      << both.err;
  outside["pipeline"].push_back({{"type", "probes.region"}, {"field", "height"}});
  const Result two = run(outside);  // a missing field does not hide the plane
  EXPECT_NE(two.err.find("/pipeline/8/point"), std::string::npos) << two.err;
  EXPECT_NE(two.err.find("/field: \"height\": expected a field that this run has"),
            std::string::npos)
      << two.err;
  outside["pipeline"].back()["field"] = "stress_zz";
  EXPECT_NE(run(outside).err.find("did you mean \"stress\" with component \"zz\"?"),
            std::string::npos);
  nlohmann::json half = tension("pull", statics);
  half["pipeline"][7].erase("normal");
  EXPECT_NE(run(half).err.find("\"area\" and \"normal\" together"), std::string::npos);
}

}  // namespace tension_test
