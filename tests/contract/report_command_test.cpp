// `hyperlattice report` from the command line: the contents of the page, output for programs,
// refusals and their messages. report_page.py checks the HTML itself.
#include <gtest/gtest.h>
#include <support/program.hpp>

#include <sys/stat.h>

namespace {
using namespace hyperlattice::test;
using nlohmann::json;
using Words = std::vector<std::string>;
namespace fs = std::filesystem;

class ReportCommand : public testing::Test {
 protected:
  /// Runs the small sphere into a folder of this test.
  void run(const std::string& name, const json& changes = json::object()) {
    json scene = small_sphere();
    scene["pipeline"].push_back({{"type", "probes.point"},
                                 {"name", "outer"},
                                 {"position", {"8 mm", 0, 0}},
                                 {"component", "x"}});
    for (const auto& [pointer, value] : changes.items()) scene[json::json_pointer(pointer)] = value;
    const Result result =
        run_program({"run", write_scene(folder_, scene), "--out", out(name), "--quiet"});
    ASSERT_TRUE(result.exit_code == 0 || result.exit_code == 3) << result.err;
  }
  std::string out(const std::string& name) const { return folder_.file(name); }
  std::string page(const std::string& name) const { return contents(out(name) + "/report.html"); }
  static Result report(Words words) {
    words.insert(words.begin(), "report");
    return run_program(words);
  }
  static const json& finding(const json& run, const std::string& about) {
    for (const json& finding : run.at("findings"))
      if (finding.at("about") == about) return finding;
    throw std::runtime_error("no finding about " + about + " in " + run.dump(1));
  }
  static void write(const std::string& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
  }

  /// Expects exit code 2, no page, and a message with all of the parts and no further faults.
  void expect_refused(Words words, const Words& parts) {
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
    EXPECT_FALSE(fs::exists(file));
    EXPECT_EQ(result.out, "");
  }

  Folder folder_{"report"};
};

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

TEST_F(ReportCommand, RefusesWhatItCannotUnderstandAllAtOnce) {
  run("good");
  for (const char* name : {"empty", "torn", "wrong", "listed"}) fs::create_directory(out(name));
  write(out("torn") + "/summary.json", R"({"status": "done", "partic)");
  write(out("torn") + "/scene.resolved.json", R"({"pipeline": [)");
  write(out("wrong") + "/summary.json", R"({"particles": 3})");
  write(out("wrong") + "/history.csv", "time,step,kinetic\n0,0,0\n1e-6,one,0\n");
  write(out("listed") + "/summary.json", "[]");
  const std::string history = out("wrong") + "/history.csv";
  expect_refused({out("good"), out("good"), out("nowhere"), out("empty"), out("torn"), out("wrong"),
                  out("listed")},
                 {out("good") + ": expected each folder once",
                  out("nowhere") + ": expected a folder with what a run left",
                  out("empty") + ": expected a run's summary.json or history.csv",
                  out("torn") + "/summary.json line 1, column 27: expected valid JSON",
                  out("torn") + "/scene.resolved.json line 1, column 15: expected valid JSON",
                  out("wrong") + "/summary.json /status: expected \"done\"",
                  history + " line 3: \"one\": expected a number in column \"step\"",
                  history + ": expected the columns of a history; it has no stored, dissipated, "
                            "injected, relative_error, broken_open, broken_closed",
                  out("listed") + "/summary.json: []: expected an object"});
}

/// With any content of its files, the command gives a page, or exit code 2 with a message and no
/// page.
TEST_F(ReportCommand, BearsFilesOfAnyContent) {
  run("run");
  const std::string summary = out("run") + "/summary.json",
                    scene = out("run") + "/scene.resolved.json";
  const auto expect_borne = [&](const std::string& what) {
    fs::remove(out("page.html"));
    const Result result = report({out("run"), "--out", out("page.html"), "--json"});
    EXPECT_TRUE(result.exit_code == 0 || result.exit_code == 2)
        << what << ": " << result.exit_code << ' ' << result.err;
    EXPECT_EQ(fs::exists(out("page.html")), result.exit_code == 0) << what;
    if (result.exit_code == 2) {
      EXPECT_NE(result.err.find(out("run")), std::string::npos) << what;
    }
    return result.exit_code;
  };
  for (const std::string& file : {summary, scene}) {  // each value gets another type
    const json good = read_json(file);
    for (const auto& [key, value] : good.items())
      for (const json& other :
           {json(), json(-1e300), json("text"), json::array({1, "a"}), json::object({{"a", 1}})}) {
        json changed = good;
        changed[key] = other;
        write(file, changed.dump());
        expect_borne(key + " = " + other.dump());
      }
    write(file, good.dump());
  }
  for (const std::string& file :
       {summary, scene, out("run") + "/history.csv", out("run") + "/probes/outer.csv"}) {
    const std::string good = contents(file);
    for (const double share : {0.0, 0.03, 0.3, 0.7, 0.99}) {
      write(file,
            good.substr(0, static_cast<std::size_t>(share * static_cast<double>(good.size()))));
      EXPECT_EQ(expect_borne("cut " + file), file.ends_with(".csv") && share > 0.1 ? 0 : 2)
          << file << ' ' << share;
    }
    write(file, good);
    EXPECT_EQ(expect_borne("whole"), 0);
  }
}

TEST_F(ReportCommand, ShowsOnlyWhatThisRunWrote) {
  const json picture = {
      {"type", "writers.picture"}, {"every", "2 us"}, {"width", 64}, {"height", 64}};
  run("again", {{"/pipeline/5", picture}});
  for (const char* file : {"/picture_000004.png", "/picture_000005.png", "/probes/outer.csv"})
    fs::copy(out("again") + file, out(fs::path(file).filename().string()));
  run("again",
      {{"/pipeline/5", picture}, {"/pipeline/4/name", "top"}, {"/pipeline/3/end_time", "4 us"}});
  // The files look as if the earlier run had left them.
  for (const char* file : {"/picture_000004.png", "/picture_000005.png", "/probes/outer.csv"})
    fs::copy(out(fs::path(file).filename().string()), out("again") + file,
             fs::copy_options::overwrite_existing);
  fs::copy(out("again") + "/picture_000004.png", out("again") + "/picture_000003.png",
           fs::copy_options::overwrite_existing);
  write(out("again") + "/failures.csv", "step,time\n1,1e-6\n2,2e-6\n");
  const Result result = report({out("again")});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string text = page("again");
  EXPECT_NE(text.find("picture_000002.png at "), std::string::npos);
  EXPECT_EQ(text.find("picture_000003.png"), std::string::npos) << "it is later than the run's end";
  EXPECT_NE(text.find("Probe top"), std::string::npos);
  EXPECT_EQ(text.find("Probe outer"), std::string::npos);
  EXPECT_EQ(result.out.find("the first broke"), std::string::npos);
}

TEST_F(ReportCommand, ReadsOnlyRegularFilesInsideTheFolder) {
  run("run", {{"/pipeline/5",
               {{"type", "writers.picture"}, {"every", 0}, {"width", 64}, {"height", 64}}}});
  const std::string picture = contents(out("run") + "/picture_000000.png");
  write(out("outside_000000.png"), "secret");
  write(out("outside.csv"), "time,secret\n0,1\n1,2\n");
  const json good = read_json(out("run") + "/scene.resolved.json");
  const auto page_without_secret = [&](const std::string& what) {
    const Result result = report({out("run")});
    EXPECT_EQ(result.exit_code, 0) << what << result.err;
    EXPECT_EQ(page("run").find("c2VjcmV0"), std::string::npos) << what;  // "secret" in base64
    EXPECT_EQ(page("run").find("secret"), std::string::npos) << what;
    return result.out;
  };
  for (const std::string& name : {std::string("../outside"), out("outside")}) {
    json changed = good;
    changed["pipeline"][5]["file"] = name;
    write(out("run") + "/scene.resolved.json", changed.dump());
    EXPECT_NE(page_without_secret(name).find("leads out of the folder"), std::string::npos);
    changed = good;
    changed["pipeline"][4]["name"] = name == "../outside" ? "../../outside" : name;
    write(out("run") + "/scene.resolved.json", changed.dump());
    expect_refused({out("run")}, {"a name that leads out of the folder: expected a regular file"});
  }
  write(out("run") + "/scene.resolved.json", good.dump());
  fs::remove(out("run") + "/picture_000000.png");
  fs::create_symlink(out("outside_000000.png"), out("run") + "/picture_000000.png");
  EXPECT_NE(page_without_secret("a link").find("picture_000000.png is a link"), std::string::npos);
  fs::remove(out("run") + "/picture_000000.png");
  write(out("run") + "/picture_000000.png", "secret");
  EXPECT_NE(page_without_secret("no picture").find("picture_000000.png is no PNG picture"),
            std::string::npos);
  fs::remove(out("run") + "/picture_000000.png");
  ASSERT_EQ(mkfifo((out("run") + "/picture_000000.png").c_str(), 0600), 0);
  ASSERT_EQ(mkfifo((out("run") + "/probes/pipe.csv").c_str(), 0600), 0);
  page_without_secret("a pipe");
  fs::remove(out("run") + "/history.csv");
  ASSERT_EQ(mkfifo((out("run") + "/history.csv").c_str(), 0600), 0);
  expect_refused({out("run")},
                 {"/history.csv: a folder, device or pipe: expected a regular file of at most"});
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

TEST_F(ReportCommand, TakesThePlaceOfNothingElse) {
  run("one");
  write(out("one") + "/files.csv", contents(out("one") + "/files.csv") + ",,mine.html\n");
  write(out("one") + "/mine.html", "a writer's");
  for (const std::string name : {"one/summary.json", "one/history.csv", "one/probes/outer.csv",
                                 "one/files.csv", "one/mine.html", "scene.json"}) {
    fs::create_symlink(out(name), out("link.html"));
    const std::string before = contents(out(name));
    for (const std::string& file : {out(name), out("link.html")}) {
      const Result result = report({out("one"), "--out", file});
      EXPECT_EQ(result.exit_code, 2) << result.err;
      EXPECT_NE(result.err.find("--out: " + file + ": expected "), std::string::npos) << result.err;
      EXPECT_EQ(result.out, "");
      EXPECT_EQ(contents(out(name)), before) << file;
    }
    fs::remove(out("link.html"));
  }
}

TEST_F(ReportCommand, WritesIntoLinksAndDevicesAndSaysWhereALinkLeadsNowhere) {
  run("one");
  write(out("target.html"), "an earlier page");
  fs::create_symlink("target.html", out("page"));
  EXPECT_EQ(report({out("one"), "--out", out("page")}).exit_code, 0);
  EXPECT_TRUE(fs::is_symlink(out("page")));
  EXPECT_NE(contents(out("target.html")).find("small sphere"), std::string::npos);
  EXPECT_EQ(report({out("one"), "--out", "/dev/null"}).exit_code, 0);
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  for (int twice = 0; twice < 2; ++twice)
    EXPECT_EQ(report({out("one"), "--out", out("new.HTM")}).exit_code, 0);

  fs::create_symlink("nowhere.html", out("dangling.html"));
  fs::create_symlink("itself.html", out("itself.html"));
  for (const auto& [name, part] :
       {std::pair{"dangling.html", "a link to nowhere.html, where none is"},
        std::pair{"itself.html", "in a circle"}}) {
    const Result result = report({out("one"), "--out", out(name)});
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
    EXPECT_TRUE(fs::is_symlink(out(name)));
  }
  EXPECT_FALSE(fs::exists(out("nowhere.html")));
}

TEST_F(ReportCommand, WritesIntoNothingUnderANameThatNobodyGave) {
  run("one");
  run("two");
  write(out("secret.txt"), "secret");
  write(out("other.html"), "a page");
  Launch here;
  here.directory = out("");
  const std::vector<std::pair<std::string, Words>> calls{
      {out("one") + "/report.html", {"report", out("one")}},
      {out("report.html"), {"report", out("one"), out("two")}}};
  for (const auto& [file, words] : calls) {
    const auto expect_left = [&, &file = file, &words = words](const std::string& what) {
      const Result result = run_program(words, here);
      EXPECT_EQ(result.exit_code, 2) << what << result.err;
      EXPECT_NE(result.err.find("report.html: expected a regular file, or nothing, of that name"),
                std::string::npos)
          << what << result.err;
      EXPECT_EQ(contents(out("secret.txt")), "secret");
      EXPECT_EQ(contents(out("other.html")), "a page");
      EXPECT_FALSE(fs::exists(out("nowhere.html")));
      fs::remove(file);
    };
    for (const std::string target : {"secret.txt", "other.html", "nowhere.html"}) {
      fs::create_symlink(out(target), file);
      expect_left(target);
    }
    ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
    expect_left("a pipe");
    for (int twice = 0; twice < 2; ++twice) EXPECT_EQ(run_program(words, here).exit_code, 0);
  }
}

TEST_F(ReportCommand, ShowsTheGoodPicturesBesideBadOnes) {
  run("run", {{"/pipeline/5",
               {{"type", "writers.picture"}, {"every", "2 us"}, {"width", 64}, {"height", 64}}}});
  const auto name = [](int n) { return "picture_00000" + std::to_string(n) + ".png"; };
  const auto file = [&](int n) { return out("run") + "/" + name(n); };
  const std::string good = contents(file(0));
  ASSERT_TRUE(fs::exists(file(4)));
  write(out("outside.png"), good);
  const std::vector<std::pair<std::string, std::function<void(const std::string&)>>> faults{
      {"a link", [&](const std::string& at) { fs::create_symlink(out("outside.png"), at); }},
      {"no PNG picture", [&](const std::string& at) { write(at, "text"); }},
      {"a folder, device or pipe",
       [](const std::string& at) { ASSERT_EQ(mkfifo(at.c_str(), 0600), 0); }}};
  for (const int bad : {0, 1, 4})
    for (const auto& [what, make] : faults) {
      const std::string before = contents(file(bad));
      fs::remove(file(bad));
      make(file(bad));
      const Result result = report({out("run")});
      EXPECT_EQ(result.exit_code, 0) << result.err;
      EXPECT_NE(result.out.find(name(bad) + " is " + what + ", and is not shown."),
                std::string::npos)
          << result.out;
      for (int n = 0; n < 5; ++n)
        EXPECT_EQ(page("run").find("alt=\"" + name(n)) != std::string::npos, n != bad)
            << n << ' ' << bad << ' ' << what;
      fs::remove(file(bad));
      write(file(bad), before);
    }
  for (int n = 0; n < 5; ++n) write(file(n), "text");
  const Result none = report({out("run")});
  EXPECT_EQ(none.exit_code, 0) << none.err;
  EXPECT_NE(none.out.find("more files of the pictures picture are not shown."), std::string::npos)
      << none.out;

  // The folder is a link, so that the files in it do not count.
  json scene = read_json(out("run") + "/scene.resolved.json");
  scene["pipeline"][5]["file"] = "linked/picture";
  write(out("run") + "/scene.resolved.json", scene.dump());
  fs::create_directory_symlink(".", out("run") + "/linked");
  const Result linked = report({out("run")});
  EXPECT_EQ(linked.exit_code, 0) << linked.err;
  EXPECT_NE(linked.out.find("linked/picture_000000.png is a link"), std::string::npos)
      << linked.out;
}

TEST_F(ReportCommand, RefusesCommandsThatMakeNoSense) {
  run("good");
  EXPECT_EQ(report({}).exit_code, 2);
  EXPECT_EQ(report({out("good"), "--out", out("good")}).exit_code, 2) << "a folder is no file";
  EXPECT_EQ(report({out("good"), "--out", out("nowhere/report.html")}).exit_code, 4)
      << "the disk refuses";
  EXPECT_FALSE(fs::exists(out("good") + "/report.html"));
}

}  // namespace
