// The commands from the command line: exit codes, places of results, output for programs.
#include <gtest/gtest.h>
#include <support/program.hpp>

namespace hyperlattice {
namespace command_line_test {

using nlohmann::json;

/// A temporary folder with a small scene. The program runs in this folder.
class CommandLine : public testing::Test {
 protected:
  CommandLine() {
    std::ofstream(folder_.file("cube.json")) << R"({"format": "hyperlattice/1", "pipeline": [
      {"type": "lattices.cubic", "spacing": 1, "shape": {"box": {"low": [0, 0, 0], "high": [3, 3, 3]}}},
      {"type": "materials.elastic", "young": 1e9, "poisson": 0.25, "density": 1000},
      {"type": "loads.start_velocity", "on": "z_max", "linear": [0, 0, 0.001]},
      {"type": "solvers.explicit", "end_time": 0.01}]})";
  }

  test::Result run(const std::vector<std::string>& arguments,
                   const std::string& subfolder = "") const {
    test::Launch launch;
    launch.directory = folder_.file(subfolder);
    return test::run_program(arguments, launch);
  }
  bool exists(const std::string& file) const { return std::filesystem::exists(folder_.file(file)); }
  json read(const std::string& file) const { return test::read_json(folder_.file(file)); }

  test::Folder folder_{"command_line"};
};

TEST_F(CommandLine, WhatCannotBeUnderstoodIsExit2) {
  const std::vector<std::vector<std::string>> lines = {{},
                                                       {"frobnicate"},
                                                       {"run"},
                                                       {"plan"},
                                                       {"run", "cube.json", "--frobnicate"},
                                                       {"run", "cube.json", "--threads", "0"},
                                                       {"run", "cube.json", "--threads", "many"},
                                                       {"run", "cube.json", "--set"},
                                                       {"run", "cube.json", "--out", "cube.json"},
                                                       {"run", "cube.json", "--out", ""},
                                                       {"run", "nowhere.json"},
                                                       {"plan", "nowhere.json"},
                                                       {"plugins", "nothing"},
                                                       {"schema", "cube.json"}};
  for (const auto& line : lines) EXPECT_EQ(run(line).exit_code, 2) << testing::PrintToString(line);
  EXPECT_NE(run({"frobnicate"}).err.find("frobnicate"), std::string::npos);
  EXPECT_NE(run({"rum", "cube.json"}).err.find("Did you mean 'run'?"), std::string::npos);
  EXPECT_NE(run({"run", "cube.json", "--overwite"}).err.find("Did you mean '--overwrite'?"),
            std::string::npos);
  EXPECT_NE(run({"run", "cube.json", "--thread=2"}).err.find("Did you mean '--threads'?"),
            std::string::npos);
  EXPECT_EQ(run({"run", "cube.json", "cube.json"}).err.find("Did you mean"), std::string::npos);
}

TEST_F(CommandLine, HelpAndVersionAreExit0) {
  for (const char* command : {"run", "plan", "watch", "plugins", "schema", "analyze", "calibrate",
                              "study", "report", "completion", "manual"})
    EXPECT_EQ(run({command, "--help"}).exit_code, 0) << command;
  EXPECT_EQ(run({"--help"}).exit_code, 0);
  EXPECT_EQ(run({"--version"}).exit_code, 0);
}

TEST_F(CommandLine, ResultsLieBesideTheUserNotTheScene) {
  std::filesystem::create_directory(folder_.file("elsewhere"));
  const test::Result result = run({"run", "../cube.json"}, "elsewhere");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(read("elsewhere/cube_out/summary.json").at("status"), "done");
  EXPECT_FALSE(exists("cube_out"));
}

TEST_F(CommandLine, ASecondRunReplacesTheFirst) {
  ASSERT_EQ(run({"run", "cube.json", "--out", "results"}).exit_code, 0);
  const json first = read("results/summary.json");
  const test::Result result = run({"run", "cube.json", "--out", "results", "--threads", "1",
                                   "--set", "/pipeline/3/end_time=0.02"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(read("results/summary.json").at("end_time"), 0.02);
  EXPECT_NE(read("results/summary.json").at("state_hash"), first.at("state_hash"));
}

TEST_F(CommandLine, WrongInputNamesEveryFaultAndWritesNothing) {
  const test::Result result =
      run({"run", "cube.json", "--set", "/pipeline/1/young=-1", "--set", "/pipeline/3/end_tme=2"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("/pipeline/1/young"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("/pipeline/3/end_tme"), std::string::npos) << result.err;
  EXPECT_FALSE(exists("cube_out"));
}

TEST_F(CommandLine, BeginsAPluginOnlyWhereThereIsNothing) {
  for (const char* type : {"failure.mine", "failures.Mine", "failures", "failures."}) {
    const test::Result result = run({"plugins", "--new", type, "--out", "project"});
    EXPECT_EQ(result.exit_code, 2) << type;
    EXPECT_NE(result.err.find("one of failures, lattices, loads, materials, surfaces, writers"),
              std::string::npos)
        << result.err;
    EXPECT_FALSE(exists("project"));
  }
  const test::Result taken = run({"plugins", "--new", "failures.strain", "--out", "project"});
  EXPECT_EQ(taken.exit_code, 2);
  EXPECT_NE(taken.err.find("a name that no component has yet"), std::string::npos) << taken.err;
  EXPECT_FALSE(exists("project"));
  ASSERT_EQ(run({"plugins", "--new", "failures.tearing_up", "--out", "project"}).exit_code, 0);
  EXPECT_TRUE(exists("project/tearing_up.cpp"));
  const test::Result again = run({"plugins", "--new", "failures.tearing_up", "--out", "project"});
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_NE(again.err.find("a folder that is not there yet"), std::string::npos) << again.err;
}

TEST_F(CommandLine, ANamedFileTakesThePlaceOfNothingElse) {
  ASSERT_EQ(run({"run", "cube.json", "--out", "results"}).exit_code, 0);
  std::ofstream(folder_.file("crystals.csv")) << "name,C11_GPa,C12_GPa,C44_GPa\nX,3,1,1\n";
  std::filesystem::create_directory(folder_.file("study"));
  std::ofstream(folder_.file("study/study.json")) << R"({"rows": []})";
  for (const char* name : {"study/study.csv", "study/study.svg"})
    std::ofstream(folder_.file(name)) << "a study's";
  const std::vector<std::vector<std::string>> lines = {
      {"analyze", "--membrane", "none", "--plot", "cube.json"},
      {"analyze", "--membrane", "none", "--plot", "study/study.svg"},
      {"analyze", "--membrane", "none", "--dispersion", "cube.json"},
      {"analyze", "--membrane", "none", "--dispersion", "study/study.csv"},
      {"analyze", "--membrane", "none", "--dispersion", "results/history.csv"},
      {"analyze", "--membrane", "none", "--crystals", "crystals.csv", "--dispersion",
       "crystals.csv"},
      {"analyze", "--membrane", "none", "--option", "points=crystals.csv", "--dispersion",
       "crystals.csv"},
      {"calibrate", "--membrane", "I-m", "--curve", "0", "4.5", "10", "--plot", "cube.json"},
      {"plugins", "--test", "failures.strain", "--pictures", "cube.json"}};
  for (const auto& line : lines) {
    const std::string file = folder_.file(line.back()), before = test::contents(file);
    const test::Result result = run(line);
    EXPECT_EQ(result.exit_code, 2) << testing::PrintToString(line) << result.err;
    EXPECT_NE(result.err.find(line[line.size() - 2] + ": " + line.back() + ": expected a"),
              std::string::npos)
        << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(test::contents(file), before) << file;
  }
}

TEST_F(CommandLine, APictureIsWrittenIntoALinkOrDevice) {
  std::ofstream(folder_.file("target.svg")) << "an earlier picture";
  std::filesystem::create_symlink("target.svg", folder_.file("link.svg"));
  for (const std::string file : {"link.svg", "/dev/null"}) {
    const test::Result result = run({"analyze", "--plot", file});
    EXPECT_EQ(result.exit_code, 0) << result.err;
  }
  EXPECT_TRUE(std::filesystem::is_symlink(folder_.file("link.svg")));
  EXPECT_NE(test::contents(folder_.file("target.svg")).find("</svg>"), std::string::npos);
}

TEST_F(CommandLine, MachinesReadWhatPeopleRead) {
  EXPECT_EQ(json::parse(run({"plan", "cube.json", "--json"}).out).at("particles"), 27);
  const json plugins = json::parse(run({"plugins", "--json", "--why"}).out);
  EXPECT_GE(plugins.at("components").size(), 10u);
  EXPECT_EQ(plugins.at("searched").at(0).at("outcome"), "accepted");
  const test::Result unknown = run({"plugins", "loads.fxied", "--why"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.out.find("\nsearched\n  accepted  "), std::string::npos) << unknown.out;
  EXPECT_GE(
      json::parse(run({"plugins", "loads.fxied", "--why", "--json"}).out).at("searched").size(),
      1u);
  EXPECT_EQ(json::parse(run({"plugins", "loads.fixed", "--json"}).out).at("components").size(), 1u);
  EXPECT_EQ(json::parse(run({"schema"}).out).at("type"), "object");
  EXPECT_NE(run({"plugins"}).out.find("\nloads\n  loads.actuation "), std::string::npos);
}

}  // namespace command_line_test
}  // namespace hyperlattice
