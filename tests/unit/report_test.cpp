// The parts of a report: ticks, thinned curves, number formats, shortened tables, alternative texts
// of pictures, differences of scenes.
#include <base/errors.hpp>
#include <base/figures.hpp>
#include <base/gnuplot.hpp>
#include <base/ticks.hpp>
#include <report/curves.hpp>
#include <report/differences.hpp>
#include <report/html.hpp>
#include <report/stress_strain.hpp>
#include <report/thin.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hyperlattice::report {
namespace report_test {

using Labels = std::vector<std::string>;
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

Labels labels(double low, double high, int most, bool whole = false) {
  Labels texts;
  for (const Tick& tick : round_ticks(low, high, most, whole)) {
    EXPECT_GE(tick.value, low - 1e-9 * (high - low));
    EXPECT_LE(tick.value, high + 1e-9 * (high - low));
    EXPECT_NEAR(std::stod(tick.label), tick.value, 1e-12 * std::abs(tick.value));
    texts.push_back(tick.label);
  }
  return texts;
}

TEST(Gnuplot, IsEndedWhereItHangs) {
  const auto file = std::filesystem::path(testing::TempDir()) / "hyperlattice_hanging.svg";
  std::filesystem::remove(file);
  const auto begin = std::chrono::steady_clock::now();
  try {
    draw_svg(file, "pause 100", 100, 100, std::chrono::milliseconds(200));
    FAIL() << "it did not hang";
  } catch (const OutsideError& error) {
    EXPECT_EQ(std::string(error.what()),
              file.string() + ": cannot draw it: gnuplot took longer than 0.2 s, and was ended");
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(50));
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(Gnuplot, TextsHoldNothingThatItActsOn) {
  EXPECT_EQ(gnuplot_text("'it''s' x"), "\"'it''s' x\"");
  EXPECT_EQ(gnuplot_text("`a` @b \\n \"c\""), R"("\140a\140 \100b \134n \"c\"")");
  EXPECT_EQ(gnuplot_text("two\nlines\x1b\a\x7f\xff"), "\"two\\nlines   \uFFFD\"");
}

TEST(Ticks, AreRoundNumbers) {
  EXPECT_EQ(labels(0, 60, 6), (Labels{"0", "10", "20", "30", "40", "50", "60"}));
  EXPECT_EQ(labels(0, 1, 5), (Labels{"0.0", "0.2", "0.4", "0.6", "0.8", "1.0"}));
  EXPECT_EQ(labels(0, 0.3, 3), (Labels{"0.0", "0.1", "0.2", "0.3"}));
  EXPECT_EQ(labels(-3.2, 7.9, 6), (Labels{"-2", "0", "2", "4", "6"}));
  EXPECT_EQ(labels(-0.0047, 0.0002, 5), (Labels{"-0.004", "-0.003", "-0.002", "-0.001", "0.000"}));
  EXPECT_EQ(labels(997, 1004, 4), (Labels{"998", "1000", "1002", "1004"}));
  EXPECT_EQ(labels(0, 99999, 5), (Labels{"0", "20000", "40000", "60000", "80000"}));
}

TEST(Ticks, OfCountsAreWhole) {
  EXPECT_EQ(labels(0, 1, 6, true), (Labels{"0", "1"}));
  EXPECT_EQ(labels(0, 3, 6, true), (Labels{"0", "1", "2", "3"}));
  EXPECT_EQ(labels(0, 60, 6, true), labels(0, 60, 6));
}

TEST(Ticks, AreNeverManyAndNeverMissing) {
  for (int n = 1; n < 2000; ++n) {
    const double high = std::pow(1.01, n - 1000), low = n % 3 == 0 ? -high / 3 : high / 7;
    for (const int most : {3, 5, 7}) {
      const auto ticks = round_ticks(low, high, most);
      EXPECT_LE(ticks.size(), static_cast<std::size_t>(most) + 1) << low << ' ' << high;
      EXPECT_GE(ticks.size(), 1u) << low << ' ' << high;
    }
  }
  EXPECT_TRUE(round_ticks(1, 1, 5).empty());
  EXPECT_TRUE(round_ticks(2, 1, 5).empty());
  EXPECT_TRUE(round_ticks(0, nothing, 5).empty());
  EXPECT_TRUE(round_ticks(0, std::numeric_limits<double>::infinity(), 5).empty());
}

TEST(Ticks, HaveRoundSteps) {
  EXPECT_DOUBLE_EQ(round_step(0.45, 5), 0.1);
  EXPECT_DOUBLE_EQ(round_step(1, 5), 0.2);
  EXPECT_DOUBLE_EQ(round_step(11, 5), 5);
  EXPECT_DOUBLE_EQ(round_step(30, 5), 10);
  for (const double none : {0.0, -1.0, nothing, std::numeric_limits<double>::infinity()})
    EXPECT_EQ(round_step(none, 5), 1) << none;
}

TEST(Thinning, KeepsPeaksEndsAndGaps) {
  std::vector<double> x(100000), y(x.size(), 0.0);
  for (std::size_t n = 0; n < x.size(); ++n) x[n] = static_cast<double>(n);
  y[33333] = 7;
  y[33334] = -5;
  y[77777] = nothing;
  const auto kept = thinned(x, y, 500);
  EXPECT_LE(kept.size(), 500u * 5);
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
  for (const std::size_t n :
       {std::size_t{0}, std::size_t{33333}, std::size_t{33334}, std::size_t{77777}, x.size() - 1})
    EXPECT_TRUE(std::binary_search(kept.begin(), kept.end(), n)) << n;
}

TEST(Thinning, LeavesFewPointsAndLoopsAlone) {
  const std::vector<double> x{0, 1, 2, 3}, y{0, 5, 1, 2};
  EXPECT_EQ(thinned(x, y, 2), (std::vector<std::size_t>{0, 1, 2, 3}));
  std::vector<double> loop(1000, 0.0);
  loop[500] = 1;
  EXPECT_EQ(thinned(loop, loop, 10).size(), 1000u);
  EXPECT_TRUE(thinned({}, {}, 10).empty());
}

TEST(Figures, BearPrefixes) {
  EXPECT_EQ(quantity_text(1.6e-6, "s"), "1.6 µs");
  EXPECT_EQ(quantity_text(0.2186e-6, "s"), "218.6 ns");
  EXPECT_EQ(quantity_text(0, "s"), "0 s");
  EXPECT_EQ(quantity_text(-44506, "J"), "-44.51 kJ");
  EXPECT_EQ(quantity_text(1e-3, "m/s"), "1 mm/s");
  EXPECT_EQ(quantity_text(1e-4, "m2"), "0.0001 m2") << "a prefix would be squared";
  EXPECT_EQ(quantity_text(1e-30, "s"), "1e-12 as");
  EXPECT_EQ(scale_for(4.7e-4, "").unit, "10⁻⁶");
  EXPECT_EQ(scale_for(123456, "").unit, "10³");
  EXPECT_EQ(scale_for(0.0047, "").unit, "");
  EXPECT_EQ(count_text(490432), "490 432");
  EXPECT_EQ(count_text_of(-3), "0");
  EXPECT_EQ(count_text_of(1e300), count_text(1000000000000000000));
  EXPECT_EQ(percent_text(0.003740), "0.374 %");
}

TEST(Html, IsEscaped) {
  EXPECT_EQ(escaped("<a href=\"x\">Tom & 'Jerry'</a>"),
            "&lt;a href=&quot;x&quot;&gt;Tom &amp; &#39;Jerry&#39;&lt;/a&gt;");
  EXPECT_EQ(escaped("nu = 1/4, \xCE\xBC"), "nu = 1/4, \xCE\xBC");
  EXPECT_EQ(escaped(std::string("a\0b\x1b", 4)),
            "a\xEF\xBF\xBD"
            "b\xEF\xBF\xBD");
  EXPECT_EQ(escaped("\xFFz"), "\xEF\xBF\xBDz");
}

TEST(Html, EncodesBytesAsTheStandardDoes) {  // the examples of RFC 4648, section 10
  const char* expected[] = {"", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"};
  for (std::size_t n = 0; n <= 6; ++n)
    EXPECT_EQ(data_uri("a/b", std::string("foobar").substr(0, n)),
              std::string("data:a/b;base64,") + expected[n]);
  EXPECT_EQ(data_uri("a/b", "\xFF\xFE\xFD"), "data:a/b;base64,//79");
}

TEST(ReadColumns, LeaveOutALineThatIsCutOff) {
  Faults faults;
  const Columns columns = read_columns("h.csv", "time,a\n0,1\n1,nan\n2,1.2", faults);
  EXPECT_TRUE(faults.empty());
  EXPECT_TRUE(columns.is_cut);
  ASSERT_EQ(columns.rows(), 2u);
  EXPECT_EQ(columns.find("a")->front(), 1);
  EXPECT_TRUE(std::isnan(columns.find("a")->back()));
  EXPECT_EQ(columns.find("b"), nullptr);
  EXPECT_FALSE(read_columns("h.csv", "time,a\n0,1\n", faults).is_cut);
  EXPECT_TRUE(faults.empty());
}

TEST(ReadColumns, TellTheFirstLineThatIsWrong) {
  const auto complaint = [](std::string_view text) {
    Faults faults;
    read_columns("h.csv", text, faults);
    return faults.size() == 1 ? InputError(faults.all()).what()
                              : std::string(faults.empty() ? "none" : "many");
  };
  EXPECT_EQ(complaint("time,a\n0,1\n1\n2\n"),
            "h.csv line 3: 1 cells: expected 2, as in the first line");
  EXPECT_EQ(complaint("time,a\n0,x\ny,1\n"),
            "h.csv line 2: \"x\": expected a number in column \"a\"");
  EXPECT_EQ(complaint(""), "h.csv: expected a table whose first line names its columns");
  EXPECT_EQ(complaint("tim"), "h.csv: expected a table whose first line names its columns");
}

TEST(Pictures, AreChosenEvenly) {
  EXPECT_EQ(evenly(100, 6), (std::vector<std::size_t>{0, 20, 40, 59, 79, 99}));
  EXPECT_EQ(evenly(3, 6), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(evenly(5, 1), (std::vector<std::size_t>{4}));
  EXPECT_TRUE(evenly(0, 6).empty());
}

TEST(Pictures, SayWhatTheyShow) {
  using std::string_literals::operator""s;
  const std::string head = "\x89PNG\r\n\x1a\n"s + "\0\0\0\x02IHDRxxcrc."s;
  const std::string text = "\0\0\0\x0a"s + "tEXtTime\0"s + "1e-5 crc."s, end = "\0\0\0\0IDATcrc."s;
  const auto found = png_texts(head + text + end + text);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].first, "Time");
  EXPECT_EQ(found[0].second, "1e-5 ");
  EXPECT_TRUE(png_texts("no picture").empty());
  EXPECT_TRUE(png_texts(head + "\xff\xff\xff\xff"s + "tEXtTime\0"s).empty())
      << "longer than the file";
}

TEST(Differences, AreTheInnermostPlaces) {
  const Json a = Json::parse(
      R"({"title": "a", "pipeline": [{"type": "x", "n": 1, "at": [0, 0, 1]}, {"type": "y", "n": 1}]})");
  Json b = a;
  EXPECT_TRUE(differences({a, b}).empty());
  b["pipeline"][0]["at"][2] = 2;
  b["pipeline"][0]["new/key"] = {{"deep", 1}};
  b["pipeline"][1]["type"] = "z";
  b["pipeline"].push_back({{"type", "w"}});
  const auto found = differences({a, Json(), b});
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found[0].pointer, "/pipeline/0/at");
  EXPECT_EQ(found[0].values,
            (std::vector<Json>{Json::array({0, 0, 1}), Json(), Json::array({0, 0, 2})}));
  EXPECT_EQ(found[1].pointer, "/pipeline/0/new~1key");
  EXPECT_EQ(found[1].values[0], Json());
  EXPECT_EQ(found[2].pointer, "/pipeline/1") << "another type of stage is another stage";
  EXPECT_EQ(found[3].pointer, "/pipeline/2");
  EXPECT_TRUE(differences({Json(), a}).empty());
  EXPECT_TRUE(differences({}).empty());
}

TEST(Plots, DrawWhatCannotBeScaled) {
  for (const std::vector<double>& y : {std::vector<double>{0, 0},
                                       {5, 5},
                                       {nothing, 1e-300},
                                       {1e299, -1e299},
                                       {1.7e308, 1},
                                       {3, nothing}}) {
    const Plot plot{"t", {"time", "s"}, {"y", ""}, {{"<a>", {0, 1}, y}}};
    ASSERT_TRUE(has_points(plot));
    const std::string picture = svg(plot);
    for (const char* wrong : {"nan", "inf", "<a>"})
      EXPECT_EQ(picture.find(wrong), std::string::npos) << picture;
  }
  EXPECT_FALSE(has_points(
      {"t", {"time", "s"}, {"y", ""}, {{"a", {0, 1}, {nothing, nothing}}, {"b", {}, {}}}}));
}

RunRecord run_with(const std::string& probe, const std::string& table) {
  RunRecord run;
  run.label = "run";
  Faults faults;
  run.probes.push_back({probe, read_columns(probe, table, faults)});
  EXPECT_TRUE(faults.empty());
  return run;
}

TEST(ProbePlots, StandWhereTheyBelong) {
  const auto titles = [](const std::vector<Plot>& plots) {
    Labels names;
    for (const Plot& plot : plots)
      names.push_back(plot.title + " over " + plot.x.name + ": " +
                      std::to_string(plot.series.size()));
    return names;
  };
  const RunRecord point = run_with(
      "p", "time,velocity_x@(0 0 0),velocity_y@(0 0 0),velocity_z@(0 0 0)\n0,1,2,3\n1,1,2,3\n");
  EXPECT_EQ(titles(plots_of(point)), (Labels{"Probe p: velocity over time: 3"}));
  const RunRecord region =
      run_with("p", "time,damage_mean,damage_min,damage_max,radius\n0,1,2,3,4\n1,1,2,3,4\n");
  EXPECT_EQ(titles(plots_of(region)),
            (Labels{"Probe p: damage over time: 3", "Probe p: radius over time: 1"}));
  EXPECT_EQ(plots_of(region)[1].y.unit, "m");
  const RunRecord line = run_with("p", "time,height@(0 0 0),height@(3 4 0)\n0,0,0\n0,1,2\n9,5,6\n");
  const auto plots = plots_of(line);
  ASSERT_EQ(titles(plots), (Labels{"Probe p: height over distance from the first place: 2"}));
  EXPECT_EQ(plots[0].series[0].x, (std::vector<double>{0, 5}));
  EXPECT_EQ(plots[0].series[0].y, (std::vector<double>{1, 2}))
      << "of two states at one time the last";
  EXPECT_EQ(plots[0].series[1].label, "at 9 s");

  const std::vector<RunRecord> both{region, region}, mixed{point, line};
  EXPECT_EQ(titles(plots_together(both)),
            (Labels{"Probe p: damage_mean over time: 2", "Probe p: radius over time: 2"}));
  EXPECT_TRUE(plots_together(mixed).empty());
}

TEST(StressOverStrain, PairsLoadCellsAndGauges) {
  RunRecord run;
  run.probes = {{"cell", {{"time", "force_x", "stress"}, {{0, 1, 2}, {0, 3, 6}, {0, 30, 60}}}},
                {"gauge", {{"time", "elongation", "strain"}, {{0, 1}, {0, 0.1}, {0, 0.01}}}},
                {"other", {{"time", "strain"}, {{0.5, 1}, {0, 0.2}}}}};
  const Plot plot = stress_over_strain(run);
  ASSERT_EQ(plot.series.size(), 1u);  // the other gauge has other times
  EXPECT_EQ(plot.series[0].label, "cell over gauge");
  EXPECT_EQ(plot.series[0].x, (std::vector<double>{0, 0.01}));
  EXPECT_EQ(plot.series[0].y, (std::vector<double>{0, 30}));
  run.probes.erase(run.probes.begin());
  EXPECT_FALSE(has_points(stress_over_strain(run)));
}

}  // namespace report_test
}  // namespace hyperlattice::report
