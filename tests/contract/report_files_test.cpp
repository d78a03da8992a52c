// The files of `hyperlattice report`: files that it reads or refuses, and places to which it writes
// the page.
#include <gtest/gtest.h>
#include <support/report.hpp>

#include <sys/stat.h>

namespace report_files_test {
using namespace hyperlattice::test;
using nlohmann::json;
using Words = std::vector<std::string>;
namespace fs = std::filesystem;

using ReportFiles = ReportCommand;

TEST_F(ReportFiles, RefusesWhatItCannotUnderstandAllAtOnce) {
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
TEST_F(ReportFiles, BearsFilesOfAnyContent) {
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

TEST_F(ReportFiles, ShowsOnlyWhatThisRunWrote) {
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

TEST_F(ReportFiles, ReadsOnlyRegularFilesInsideTheFolder) {
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

TEST_F(ReportFiles, TakesThePlaceOfNothingElse) {
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

TEST_F(ReportFiles, WritesIntoLinksAndDevicesAndSaysWhereALinkLeadsNowhere) {
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

TEST_F(ReportFiles, WritesIntoNothingUnderANameThatNobodyGave) {
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

TEST_F(ReportFiles, ShowsTheGoodPicturesBesideBadOnes) {
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

TEST_F(ReportFiles, RefusesCommandsThatMakeNoSense) {
  run("good");
  EXPECT_EQ(report({}).exit_code, 2);
  EXPECT_EQ(report({out("good"), "--out", out("good")}).exit_code, 2) << "a folder is no file";
  EXPECT_EQ(report({out("good"), "--out", out("nowhere/report.html")}).exit_code, 4)
      << "the disk refuses";
  EXPECT_FALSE(fs::exists(out("good") + "/report.html"));
}

}  // namespace report_files_test
