// The command `hyperlattice report` in a test.
#pragma once

#include <gtest/gtest.h>
#include <support/program.hpp>

namespace hyperlattice::test {

/// Runs the command on runs in a folder of the test.
class ReportCommand : public testing::Test {
 protected:
  /// Runs the small sphere into a folder of this test.
  void run(const std::string& name, const nlohmann::json& changes = nlohmann::json::object()) {
    nlohmann::json scene = small_sphere();
    scene["pipeline"].push_back({{"type", "probes.point"},
                                 {"name", "outer"},
                                 {"position", {"8 mm", 0, 0}},
                                 {"component", "x"}});
    for (const auto& [pointer, value] : changes.items())
      scene[nlohmann::json::json_pointer(pointer)] = value;
    const Result result =
        run_program({"run", write_scene(folder_, scene), "--out", out(name), "--quiet"});
    ASSERT_TRUE(result.exit_code == 0 || result.exit_code == 3) << result.err;
  }
  std::string out(const std::string& name) const { return folder_.file(name); }
  std::string page(const std::string& name) const { return contents(out(name) + "/report.html"); }
  static Result report(std::vector<std::string> words) {
    words.insert(words.begin(), "report");
    return run_program(words);
  }
  static const nlohmann::json& finding(const nlohmann::json& run, const std::string& about) {
    for (const nlohmann::json& finding : run.at("findings"))
      if (finding.at("about") == about) return finding;
    throw std::runtime_error("no finding about " + about + " in " + run.dump(1));
  }
  static void write(const std::string& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
  }

  /// Expects exit code 2, no page, and a message with all of the parts and no further faults.
  void expect_refused(std::vector<std::string> words, const std::vector<std::string>& parts) {
    const std::string file = out("refused.html");
    words.insert(words.end(), {"--out", file});
    const Result result = report(words);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    for (const std::string& part : parts)
      EXPECT_NE(result.err.find(part), std::string::npos) << "missing: " << part << '\n'
                                                          << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'),
              1 + static_cast<std::ptrdiff_t>(parts.size()))
        << result.err;
    EXPECT_FALSE(std::filesystem::exists(file));
    EXPECT_EQ(result.out, "");
  }

  Folder folder_{"report"};
};

}  // namespace hyperlattice::test
