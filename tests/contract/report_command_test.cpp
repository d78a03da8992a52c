// `hyperlattice report` from the command line: the contents of the page and the output for
// programs. report_page.py checks the HTML itself.
#include <gtest/gtest.h>
#include <support/report.hpp>

namespace report_command_test {
using namespace hyperlattice::test;
using nlohmann::json;
namespace fs = std::filesystem;

TEST_F(ReportCommand, SaysWhatTheSummarySays) {
  run("one");
  const Result result = report({out("one"), "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json found = json::parse(result.out), summary = read_json(out("one") + "/summary.json");
  EXPECT_EQ(found.at("file"), out("one") + "/report.html");
  ASSERT_EQ(found.at("runs").size(), 1u);
  const json& reported = found["runs"][0];
  EXPECT_EQ(reported.at("status"), "done");
  EXPECT_EQ(reported.at("title"), "small sphere");
  for (const char* key : {"particles", "springs", "steps", "time_step", "state_hash",
                          "wall_seconds", "broken_springs"})
    EXPECT_EQ(reported.at("figures").at(key), summary.at(key)) << key;
  const json step = finding(reported, "time_step").at("numbers");
  EXPECT_EQ(step.at("time_step"), summary["time_step"]);
  EXPECT_EQ(step.at("critical_time_step"), summary["critical_time_step"]);
  EXPECT_DOUBLE_EQ(step.at("share"), summary["time_step"].get<double>() /
                                         summary["critical_time_step"].get<double>());
  EXPECT_EQ(finding(reported, "time_step").at("judgement"), "fine");
  const json energy = finding(reported, "energy_balance").at("numbers");
  EXPECT_EQ(energy.at("relative_error"), summary["energy"]["relative_error"]);
  EXPECT_EQ(energy.at("largest_relative_error"), summary["energy"]["largest_relative_error"]);
  EXPECT_EQ(energy.at("energy_tolerance"), 0.05) << "the default of solvers.explicit";
  EXPECT_EQ(finding(reported, "energy_balance").at("judgement"), "fine");

  const std::string text = page("one");
  for (const std::string part : {"small sphere", "No spring of this scene can break.",
                                 "Probe outer: displacement_x", "&quot;pipeline&quot;"})
    EXPECT_NE(text.find(part), std::string::npos) << part;
  for (const json& said : reported["findings"])
    EXPECT_NE(report({out("one")}).out.find(said.at("sentence").get<std::string>()),
              std::string::npos);
  EXPECT_NE(result.err.find("report.html"), std::string::npos) << "it says where the page is";
}

TEST_F(ReportCommand, IsTheSamePageForTheSameResults) {
  run("one");
  ASSERT_EQ(report({out("one")}).exit_code, 0);
  const std::string first = page("one");
  ASSERT_EQ(report({out("one")}).exit_code, 0);
  EXPECT_EQ(page("one"), first);
  EXPECT_FALSE(fs::exists(out("one") + "/report.html.part"));
}

TEST_F(ReportCommand, PutsRunsSideBySide) {
  run("soft", {{"/pipeline/1/young", "5 GPa"}});
  run("hard", {{"/title", "harder"}});
  Launch here;
  here.directory = out("");
  const Result result = run_program({"report", "soft", "hard", "--json"}, here);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json found = json::parse(result.out);
  EXPECT_EQ(found.at("file"), "report.html");
  ASSERT_EQ(found.at("differences").size(), 2u);
  EXPECT_EQ(found["differences"][0],
            json::parse(R"({"pointer": "/title", "values": ["small sphere", "harder"]})"));
  EXPECT_EQ(found["differences"][1],
            json::parse(R"({"pointer": "/pipeline/1/young", "values": [5e9, 10e9]})"));
  const std::string text = contents(out("report.html"));
  for (const char* part :
       {"Report of 2 runs", "/pipeline/1/young", "Energy, kinetic", "Energy, stored",
        "Energy, dissipated", "Energy, injected", "soft: small sphere", "hard: harder"})
    EXPECT_NE(text.find(part), std::string::npos) << part;
}

TEST_F(ReportCommand, TellsWhyARunFailed) {
  run("broken", {{"/pipeline/2/peak", 1e200}, {"/pipeline/3/energy_tolerance", 0}});
  const Result result = report({out("broken"), "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json reported = json::parse(result.out)["runs"][0],
             summary = read_json(out("broken") + "/summary.json");
  ASSERT_EQ(summary["status"], "failed");
  EXPECT_EQ(reported["status"], "failed");
  EXPECT_EQ(finding(reported, "reason").at("sentence"), summary["reason"]);
  EXPECT_EQ(finding(reported, "reason").at("judgement"), "wrong");
  EXPECT_EQ(finding(reported, "energy_balance").at("judgement"), "doubtful")
      << "nothing would have stopped it";
}

TEST_F(ReportCommand, TellsWhenSpringsBreak) {
  run("breaking",
      {{"/pipeline/1/failure", {{"type", "failures.elongation"}, {"limit", "1e-3 mm"}}}});
  const Result result = report({out("breaking"), "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json summary = read_json(out("breaking") + "/summary.json"),
             numbers = finding(json::parse(result.out)["runs"][0], "broken_springs").at("numbers");
  ASSERT_GT(summary["broken_springs"]["open"], 0);
  EXPECT_EQ(numbers.at("open"), summary["broken_springs"]["open"]);
  EXPECT_EQ(numbers.at("closed"), summary["broken_springs"]["closed"]);
  const std::string first = table_rows(out("breaking") + "/failures.csv").at(0);  // step,time,...
  EXPECT_EQ(numbers.at("first_time"), std::stod(first.substr(first.find(',') + 1)));
  EXPECT_NE(page("breaking").find("<figcaption>Broken springs</figcaption>"), std::string::npos);
}

TEST_F(ReportCommand, ShowsTheAreaOfCracks) {
  run("cracking", {{"/pipeline/1/failure",
                    {{"type", "failures.cohesive"},
                     {"strength", "0.2 MPa"},
                     {"fracture_energy", 10},
                     {"allow_coarse", true}}}});
  ASSERT_EQ(report({out("cracking")}).exit_code, 0);
  const json cracks = read_json(out("cracking") + "/summary.json").at("cracks");
  EXPECT_GT(cracks.at("area"), 0);
  EXPECT_GT(cracks.at("surface_energy"), 0);
  EXPECT_NE(page("cracking").find("<figcaption>Area of cracks</figcaption>"), std::string::npos);
}

TEST_F(ReportCommand, TellsHowNearToRestABodyIs) {
  run("rest", {{"/pipeline/2",
                {{"type", "loads.pressure"}, {"on", "inner_surface"}, {"pressure", "1 MPa"}}},
               {"/pipeline/3", {{"type", "solvers.static"}}}});
  const Result result = report({out("rest"), "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json summary = read_json(out("rest") + "/summary.json"),
             rest = finding(json::parse(result.out)["runs"][0], "rest");
  EXPECT_EQ(rest.at("judgement"), "fine");
  EXPECT_EQ(rest["numbers"]["residual"], summary["rest"]["residual"]);
  EXPECT_EQ(rest["numbers"]["displacement_error"], summary["rest"]["displacement_error"]);
  EXPECT_EQ(rest["numbers"]["tolerance"], 1e-6) << "the default of solvers.static";
}

TEST_F(ReportCommand, ShowsARunThatIsCutOff) {
  run("cut");
  fs::remove(out("cut") + "/summary.json");
  write(out("cut") + "/checkpoint.bin", "");
  std::string history = contents(out("cut") + "/history.csv");
  const auto rows = table_rows(out("cut") + "/history.csv");
  history.resize(history.size() - rows.back().size() / 2);  // cuts the last line
  write(out("cut") + "/history.csv", history);
  const Result result = report({out("cut"), "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json reported = json::parse(result.out)["runs"][0];
  EXPECT_EQ(reported["status"], "unfinished");
  EXPECT_EQ(reported["title"], "small sphere") << "the resolved scene knows it";
  EXPECT_EQ(finding(reported, "note").at("sentence"),
            "history.csv ends within a line, which is left out.");
  EXPECT_NE(finding(reported, "checkpoint").at("sentence").get<std::string>().find("--resume"),
            std::string::npos);
  const std::string whole = rows.at(rows.size() - 2);
  const json progress = finding(reported, "progress").at("numbers");
  EXPECT_EQ(progress.at("time"), std::stod(whole)) << "the latest whole line";
  EXPECT_EQ(progress.at("planned_end_time"), 10e-6);
  EXPECT_NE(page("cut").find("<figcaption>Energies</figcaption>"), std::string::npos);
}

TEST_F(ReportCommand, ShowsAStudy) {
  fs::create_directory(out("study"));
  write(out("study") + "/study.json",
        R"({"title": "Errors & times", "rows": [], "sentence": "The cheapest is <small>."})");
  write(out("study") + "/study.csv", "step,error\n1 us,0.01\n");
  write(out("study") + "/study.svg", "<svg/>");
  const Result result = report({out("study"), "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(json::parse(result.out)["studies"][0]["title"], "Errors & times");
  for (const char* part : {"Errors &amp; times", "The cheapest is &lt;small&gt;.", "<td>0.01</td>",
                           "data:image/svg+xml;base64,PHN2Zy8+\""})
    EXPECT_NE(page("study").find(part), std::string::npos) << part;
}

TEST_F(ReportCommand, EscapesEveryText) {
  const std::string wild =
      "</script><script>alert('x')</script> \"q\" & \u0001\u001b[31m \u007f \uFFFE";
  run("wild", {{"/title", wild}, {"/pipeline/1/young", "5 GPa"}});
  write(out("wild") + "/probes/outer.csv", "time,<b>`x`\xff\xfe\n0,1\n1,2\n");
  ASSERT_EQ(report({out("wild"), "--json"}).exit_code, 0);
  const std::string text = page("wild");
  EXPECT_EQ(text.find("<script"), std::string::npos);
  EXPECT_EQ(text.find("<b>`x`"), std::string::npos);
  EXPECT_NE(text.find("&lt;/script&gt;&lt;script&gt;alert(&#39;x&#39;)"), std::string::npos);
  for (const char c : text)
    EXPECT_TRUE(static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t');
  for (const std::string_view no_character : {"\xEF\xBF\xBE", "\xff"})
    EXPECT_EQ(text.find(no_character), std::string::npos);
}

TEST_F(ReportCommand, CallsFineOnlyWhatIsBelowTheStatedBound) {
  run("one", {{"/pipeline/3/energy_tolerance", 0.5}});
  json summary = read_json(out("one") + "/summary.json");
  for (const auto& [error, judgement] :
       {std::pair{0.002, "fine"}, std::pair{0.1, "doubtful"}, std::pair{0.6, "wrong"}}) {
    summary["energy"]["relative_error"] = summary["energy"]["largest_relative_error"] = error;
    write(out("one") + "/summary.json", summary.dump());
    const json found = json::parse(report({out("one"), "--json"}).out);
    EXPECT_EQ(finding(found["runs"][0], "energy_balance").at("judgement"), judgement) << error;
    EXPECT_NE(finding(found["runs"][0], "energy_balance")
                  .at("sentence")
                  .get<std::string>()
                  .find("fine is at most 1 %"),
              std::string::npos);
  }
}

}  // namespace report_command_test
