// Numbers of a study by hand: interpolation, norms, orders, the Pareto front, extrapolation, and
// columns of tables.
#include <study/evaluate.hpp>
#include <study/expected.hpp>
#include <study/observe.hpp>
#include <study/report.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace study_numbers_test {
using namespace hyperlattice::study;
using hyperlattice::CsvTable;
using hyperlattice::parse_csv;
using Numbers = std::vector<double>;

TEST(StudyCurve, RunsStraightBetweenItsPointsAndNowhereElse) {
  const Curve curve{{1, 2, 4}, {10, 20, 0}};
  EXPECT_DOUBLE_EQ(value_at(curve, 1), 10);
  EXPECT_DOUBLE_EQ(value_at(curve, 1.25), 12.5);
  EXPECT_DOUBLE_EQ(value_at(curve, 3), 10);
  EXPECT_DOUBLE_EQ(value_at(curve, 4), 0);
  // The end of a curve is met up to rounding.
  EXPECT_DOUBLE_EQ(value_at(curve, 4 * (1 + 1e-15)), 0);
  EXPECT_TRUE(std::isnan(value_at(curve, 0.99)));
  EXPECT_TRUE(std::isnan(value_at(curve, 4.01)));
  EXPECT_TRUE(std::isnan(value_at({}, 0)));
}

TEST(StudyCurve, IsPutInOrderAndTakesTheMeanAtOnePlace) {
  const Curve curve = sorted({{3, 1, 3, 2, 3}, {30, 10, 60, 20, 90}});
  EXPECT_EQ(curve.over, (Numbers{1, 2, 3}));
  EXPECT_EQ(curve.values, (Numbers{10, 20, 60}));
}

TEST(StudyCurve, IsReducedToOneNumber) {
  const Curve curve{{0, 1, 4}, {2, 6, -2}};
  EXPECT_EQ(reduced(curve, Reduction::none).values, curve.values);
  EXPECT_EQ(reduced(curve, Reduction::last).values, Numbers{-2});
  EXPECT_EQ(reduced(curve, Reduction::largest).values, Numbers{6});
  EXPECT_EQ(reduced(curve, Reduction::least).values, Numbers{-2});
  EXPECT_DOUBLE_EQ(reduced(curve, Reduction::mean).values[0],
                   (4.0 + 6.0) / 4);  // trapezoids of 4 and 6, over a length of 4
}

double error_of(const Curve& observed, const Curve& truth, Norm norm) {
  return distance(observed, truth, norm).relative(norm);
}

TEST(StudyNorm, CountsWhatItSays) {
  const Curve truth{{0, 1, 2}, {3, 4, 5}}, observed{{0, 2}, {3, 6}};  // interpolated: 3, 4.5, 6
  EXPECT_DOUBLE_EQ(error_of(observed, truth, Norm::relative_l2), std::sqrt(1.25 / 50));
  EXPECT_DOUBLE_EQ(error_of(observed, truth, Norm::relative_max), 1.0 / 5);
  EXPECT_DOUBLE_EQ(error_of(observed, truth, Norm::relative_end), 1.0 / 5);
  const Curve shorter{{0, 1}, {3, 4.5}};  // only the points of the truth in this range count
  EXPECT_DOUBLE_EQ(error_of(shorter, truth, Norm::relative_l2), std::sqrt(0.25 / 25));
  EXPECT_DOUBLE_EQ(error_of(shorter, truth, Norm::relative_end), 0.5 / 4);
  // Distances in this norm can be added up over several curves.
  const Distance part = distance(observed, truth, Norm::together_l2);
  EXPECT_DOUBLE_EQ(part.difference, 1.25);
  EXPECT_DOUBLE_EQ(part.size, 50);
}

TEST(StudyNorm, HasAFloorWhereTheTruthPassesZeroAtItsEnd) {
  EXPECT_DOUBLE_EQ(
      error_of({{0, 1, 2}, {0, 4, 0.1}}, {{0, 1, 2}, {0, 4, 1e-12}}, Norm::relative_end),
      (0.1 - 1e-12) / 4);
}

TEST(StudyNorm, SaysWhyThereIsNone) {
  const auto why = [](const Curve& observed, const Curve& truth) {
    try {
      error_of(observed, truth, Norm::relative_l2);
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(why({{0, 1}, {1, 1}}, {{5, 6}, {1, 1}}),
            "the run and the truth have nothing in common: the run is known from 0 to 1, the truth "
            "from 5 to 6");
  EXPECT_EQ(why({{0, 1}, {1, 1}}, {{0, 1}, {0, 0}}),
            "the truth is zero, so that there is no relative error");
}

TEST(StudyOrder, IsTheSlopeOfTheLogarithms) {
  const auto second = observed_order({{1, 0.04}, {4, 0.64}, {2, 0.16}});
  ASSERT_TRUE(second);
  EXPECT_NEAR(second->order, 2, 1e-12);
  ASSERT_EQ(second->pairs.size(), 2u);
  for (const double pair : second->pairs) EXPECT_NEAR(pair, 2, 1e-12);
  const auto mixed = observed_order(
      {{4, 1},
       {2, 0.5},
       {1, 0.125}});  // slopes 1 and 2; a fit of three equally spaced points gives their mean
  EXPECT_NEAR(mixed->pairs[0], 1, 1e-12);
  EXPECT_NEAR(mixed->pairs[1], 2, 1e-12);
  EXPECT_NEAR(mixed->order, 1.5, 1e-12);
  EXPECT_NEAR(*size_for(*second, 0.01), 0.5, 1e-12);
}

TEST(StudyOrder, IsDoubtedWhereTheMethodCannotHaveIt) {
  EXPECT_EQ(observed_order({{4, 0.16}, {2, 0.04}, {1, 0.01}})->doubt, "");
  const auto too_high = observed_order({{4, 1}, {2, 0.01}});
  EXPECT_NE(too_high->doubt.find("an order of 6.64 is more than the method can have"),
            std::string::npos)
      << too_high->doubt;
  EXPECT_FALSE(size_for(*too_high, 1e-6)) << "nothing is promised by it";
  EXPECT_NE(observed_order({{4, 1}, {2, 0.3}, {1, 0.4}})->doubt.find("does not fall"),
            std::string::npos);
  EXPECT_NE(observed_order({{4, 1}, {2, 0.9}, {1, 0.15}})->doubt.find("scatters"),
            std::string::npos);
}

TEST(StudyOrder, NeedsTwoErrorsThatAreNotZero) {
  EXPECT_FALSE(observed_order({}));
  EXPECT_FALSE(observed_order({{1, 0.1}}));
  EXPECT_FALSE(observed_order({{1, 0.1}, {2, 0}}));
  EXPECT_FALSE(observed_order({{1, 0.1}, {1, 0.2}}));
  EXPECT_FALSE(size_for(*observed_order({{1, 0.2}, {2, 0.1}}), 0.01))
      << "an error that grows never meets a target";
}

TEST(StudyFront, HoldsWhatNoOtherBeats) {
  const std::vector<Cost> costs{{0.10, 1}, {0.05, 2}, {0.06, 3}, {0.01, 9}, {0.10, 1}, {0.10, 2}};
  EXPECT_EQ(pareto_front(costs), (std::vector<bool>{true, true, false, true, true, false}));
  EXPECT_EQ(cheapest(costs, 0.06), 1u);
  EXPECT_EQ(cheapest(costs, 0.2), 0u);
  EXPECT_EQ(cheapest(costs, 0.01), 3u);
  EXPECT_FALSE(cheapest(costs, 0.001));
  EXPECT_EQ(most_accurate(costs), 3u);
  EXPECT_FALSE(most_accurate({}));
}

TEST(StudyFront, TellsTheTimeThatAnErrorTakes) {
  // Errors fall as 1 / time; {0.45, 3} is not on the front.
  const std::vector<Cost> costs{{0.1, 4}, {0.4, 1}, {0.025, 16}, {0.45, 3}};
  EXPECT_NEAR(seconds_for(costs, 0.2).value(), 2, 1e-12);
  EXPECT_NEAR(seconds_for(costs, 0.05).value(), 8, 1e-12);
  EXPECT_NEAR(seconds_for(costs, 0.025).value(), 16, 1e-12);
  EXPECT_EQ(seconds_for(costs, 0.5), 1);
  EXPECT_FALSE(seconds_for(costs, 0.02));
  EXPECT_FALSE(seconds_for({}, 1));
  EXPECT_EQ(seconds_for({{0.1, 1}, {0, 3}}, 0.05), 3) << "an error of zero has no power law";
}

/// 1 + x + c h^p at the points x of a lattice of spacing h.
SizedCurve converging(double h, double p) {
  SizedCurve curve{h, {}};
  for (double x = 0; x <= 1; x += h) {
    curve.curve.over.push_back(x);
    curve.curve.values.push_back(1 + x + 3 * std::pow(h, p));
  }
  return curve;
}

TEST(StudyExtrapolation, FindsTheLimitAndTheOrder) {
  for (const double p : {1.0, 1.7, 2.0}) {
    const std::vector<SizedCurve> even{converging(0.25, p), converging(0.125, p),
                                       converging(0.0625, p)};
    EXPECT_NEAR(order_of(even[0], even[1], even[2]), p, 1e-9);
    const Curve limit = extrapolated(even, std::nullopt);
    EXPECT_EQ(limit.over, even[1].curve.over);
    for (std::size_t n = 0; n < limit.over.size(); ++n)
      EXPECT_NEAR(limit.values[n], 1 + limit.over[n], 1e-9);
    const std::vector<SizedCurve> uneven{converging(0.5, p), converging(0.25, p),
                                         converging(0.0625, p)};
    EXPECT_NEAR(order_of(uneven[0], uneven[1], uneven[2]), p, 1e-9);
    const Curve stated = extrapolated({even[1], even[2]}, p);
    for (std::size_t n = 0; n < stated.over.size(); ++n)
      EXPECT_NEAR(stated.values[n], 1 + stated.over[n], 1e-12);
  }
}

TEST(StudyExtrapolation, RefusesWhatDoesNotConverge) {
  EXPECT_THROW(extrapolated({converging(0.25, 2)}, 2.0), std::runtime_error);
  EXPECT_THROW(extrapolated({converging(0.25, 2), converging(0.125, 2)}, std::nullopt),
               std::runtime_error);
  SizedCurve away = converging(0.0625, 2);
  for (double& value : away.curve.values) value += 5;
  EXPECT_THROW(extrapolated({converging(0.25, 2), converging(0.125, 2), away}, std::nullopt),
               std::runtime_error);
}

TEST(StudyExtrapolation, RefusesOrdersThatTheMethodCannotHave) {
  EXPECT_THROW(
      extrapolated({converging(0.25, 6.6), converging(0.125, 6.6), converging(0.0625, 6.6)},
                   std::nullopt),
      NoLimit);
  SizedCurve beyond = converging(0.0625, 2);  // the differences change their sign
  for (double& value : beyond.curve.values) value += 0.04;
  EXPECT_THROW(extrapolated({converging(0.25, 2), converging(0.125, 2), beyond}, std::nullopt),
               NoLimit);
}

Row done_row(Choice choice, double size, double error, double seconds) {
  Row row;
  row.choice = std::move(choice);
  row.status = "done";
  row.numbers = {std::nullopt, size};
  row.error = error;
  row.solve_seconds = {seconds};
  return row;
}

TEST(StudyCases, AreAnsweredForTheHardest) {
  Study study;
  study.axes.resize(2);
  study.axes[0].name = "nu";
  study.axes[0].labels = {"easy", "hard"};
  study.axes[1].name = "spacing";
  study.axes[1].labels = {"4", "2"};
  study.cases = {0};
  study.refinement = 1;
  study.target_error = 0.01;
  std::vector<Row> rows{done_row({0, 0}, 4, 0.04, 1), done_row({0, 1}, 2, 0.01, 8),
                        done_row({1, 0}, 4, 0.16, 2), done_row({1, 1}, 2, 0.04, 16)};
  const std::string sentence = cheapest_sentence(study, rows, find(study, rows));
  EXPECT_NE(sentence.find("the most accurate is spacing 2: error 4 % at most, with nu hard, 24 s "
                          "for all cases together"),
            std::string::npos)
      << sentence;
  EXPECT_NE(sentence.find("would meet it in every case at a spacing of about 1 (SI)"),
            std::string::npos)
      << sentence;
  study.target_error = 0.05;
  EXPECT_EQ(find(study, rows).cheapest, 3u);
  rows.pop_back();  // the hardest case was not run at this setting
  EXPECT_FALSE(find(study, rows).cheapest);
}

TEST(StudyEqualError, ComparesWithTheMostAccurateSetting) {
  Study study;
  study.axes.resize(2);
  study.axes[0].name = "boundary";
  study.axes[0].labels = {"particles", "cells", "spheres"};
  study.axes[0].values = {{"particles"}, {"cells"}, {"spheres"}};
  study.axes[1].name = "spacing";
  study.axes[1].labels = {"4", "2"};
  study.axes[1].values = {{4}, {2}};
  study.refinement = 1;
  const std::vector<Row> rows{done_row({0, 0}, 4, 0.4, 2), done_row({0, 1}, 2, 0.2, 16),
                              done_row({1, 0}, 4, 0.4, 1), done_row({1, 1}, 2, 0.1, 16),
                              done_row({2, 0}, 4, 0.8, 1), done_row({2, 1}, 2, 0.5, 9)};
  const Findings findings = find(study, rows);
  ASSERT_EQ(findings.equal_errors.size(), 2u);
  const EqualError &particles = findings.equal_errors[0], &spheres = findings.equal_errors[1];
  EXPECT_EQ(particles.setting[0], 0u);
  EXPECT_EQ(particles.reference[0], 1u);
  EXPECT_EQ(particles.error, 0.2);
  EXPECT_NEAR(particles.reference_seconds, 4, 1e-12) << "half way from 1 to 16, in logarithms";
  EXPECT_NEAR(particles.times(), 4, 1e-12);
  EXPECT_FALSE(particles.is_bound);
  EXPECT_EQ(spheres.reference_seconds, 1);
  EXPECT_TRUE(spheres.is_bound);
  const std::string text = study_text(study, rows, findings);
  for (const char* line :
       {"boundary particles takes 4 times as long as boundary cells for an error "
        "of 20 %: 16 s against 4 s",
        "boundary spheres takes at least 9 times as long as boundary cells"})
    EXPECT_NE(text.find(line), std::string::npos) << text;
  EXPECT_EQ(study_json(study, rows, findings)["equal_errors"][0]["against"]["boundary"], "cells");
  study.cases = {0};  // each boundary now answers a question of its own
  EXPECT_TRUE(find(study, rows).equal_errors.empty());
}

const CsvTable line = parse_csv(
    "time,displacement_x@(0.03 0 0),displacement_x@(0.01 0 0),displacement_x@(0.02 -1e-05 "
    "0),displacement_y@(0.01 0 0)\n0,0,0,0,0\n1,3,1,2,7\n");

TEST(StudyObservation, TakesALineAtTheLastTime) {
  Comparison comparison;
  comparison.probe = "line";
  comparison.column = "displacement_x";
  comparison.along = Coordinate::x;
  const Curve curve = observed_curve(comparison, line);
  EXPECT_EQ(curve.over, (Numbers{0.01, 0.02, 0.03}));
  EXPECT_EQ(curve.values, (Numbers{1, 2, 3}));
  comparison.along = Coordinate::y;
  EXPECT_EQ(observed_curve(comparison, line).over, (Numbers{-1e-5, 0}));
}

TEST(StudyObservation, TakesOneColumnOverTime) {
  Comparison comparison;
  comparison.probe = "line";
  comparison.column = "displacement_y";
  EXPECT_EQ(observed_curve(comparison, line).over, (Numbers{0, 1}));
  EXPECT_EQ(observed_curve(comparison, line).values, (Numbers{0, 7}));
  comparison.column = "displacement_x";
  EXPECT_NE(column_fault(comparison, line.columns).find("one column; 3 are called so"),
            std::string::npos);
  comparison.column = "displacement_x@(0.01 0 0)";
  EXPECT_EQ(observed_curve(comparison, line).values, (Numbers{0, 1}));
  comparison.column = "displacement_w";
  EXPECT_EQ(column_fault(comparison, line.columns),
            "a column of probe line: time, displacement_x, displacement_y; did you mean "
            "\"displacement_x\"?");
}

Truth table_truth(const std::string& text) {
  Truth truth;
  truth.kind = Truth::Kind::table;
  truth.file = "truth.csv";
  truth.table = std::make_shared<CsvTable>(parse_csv(text));
  return truth;
}

TEST(StudyTruth, IsTakenBetweenPlaces) {
  const Truth truth = table_truth("t,u@0.02,u@0.05,u@0.03\n0,0,0,0\n1,2,5,4\n");
  Comparison comparison;
  comparison.truth = "u";
  comparison.at = 0.025;
  EXPECT_NEAR(true_curve(comparison, truth, 0.025, {}).values[1], 3, 1e-12);
  EXPECT_NEAR(true_curve(comparison, truth, 0.04, {}).values[1], 4.5, 1e-12);
  EXPECT_NEAR(true_curve(comparison, truth, 0.05, {}).values[1], 5, 1e-12);
  EXPECT_THROW(true_curve(comparison, truth, 0.051, {}), std::runtime_error);
}

TEST(StudyTruth, IsTakenFromTheRowsThatFit) {
  Truth truth = table_truth(
      "line,nu,depth,x,ux\na,0.1,0,0.2,2\na,0.1,0,0.1,1\nb,0.1,0,0.1,9\na,0.2,0,0.1,8\na,0.1,0."
      "0025,0.1,7\n");
  Comparison comparison;
  comparison.truth = "ux";
  comparison.along = Coordinate::x;
  comparison.scale = 10;
  truth.where = {{"line", "a", std::nullopt, std::nullopt, 1},
                 {"nu", "", std::nullopt, 0, 1},
                 {"depth", "", std::nullopt, 1, 0.5}};
  const Curve top = true_curve(comparison, truth, std::nullopt, {0.1, 0.0});
  EXPECT_EQ(top.over, (Numbers{0.1, 0.2}));
  EXPECT_EQ(top.values, (Numbers{10, 20}));
  EXPECT_EQ(true_curve(comparison, truth, std::nullopt, {0.1, 0.005}).values, Numbers{70});
  EXPECT_THROW(true_curve(comparison, truth, std::nullopt, {0.3, 0.0}), std::runtime_error);
}

TEST(StudyTruth, RowsWithoutNumbersAreRefusedWithTheirLines) {
  const auto refusal = [](const std::string& text) -> std::string {
    Comparison comparison;
    comparison.truth = "u";
    try {
      true_curve(comparison, table_truth(text), std::nullopt, {});
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal("t,u\n0,1\n\n1,inf\none,2\n"),
            "truth.csv, line 4: expected a finite number in column \"u\", not \"inf\"; line 5: "
            "expected a finite number in column \"t\", not \"one\"");
  EXPECT_EQ(refusal("t,u,v\n0,1,none\n"), "");
}

// The truth is a curve over the load. In the run, the time is the fraction of the full load.
TEST(StudyTruth, ALoadCanStandForTheTime) {
  Truth truth = table_truth(
      "load_N,method,uy\n40,linear,-1\n80,linear,-2\n40,nonlinear,-0.9\n80,nonlinear,-1.5\n");
  Comparison comparison;
  comparison.truth = "uy";
  comparison.over = "load_N";
  comparison.over_scale = 1.0 / 80;
  comparison.where = {{"method", "nonlinear", std::nullopt, std::nullopt, 1}};
  const Curve curve = true_curve(comparison, truth, std::nullopt, {});
  EXPECT_EQ(curve.over, (Numbers{0.5, 1}));
  EXPECT_EQ(curve.values, (Numbers{-0.9, -1.5}));
}

TEST(StudyRow, CountsTheMedian) {
  Row row;
  EXPECT_EQ(row.seconds(), 0);
  row.solve_seconds = {9, 1, 2};
  EXPECT_EQ(row.seconds(), 2);
  row.solve_seconds = {9, 1, 2, 3};
  EXPECT_EQ(row.seconds(), 2.5);
}

TEST(StudyCsv, ReadsLines) {
  const CsvTable table = parse_csv("a,b\r\n1,2\r\n\n3\n4,5,6");
  EXPECT_EQ(table.columns, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(table.rows, (std::vector<std::vector<std::string>>{{"1", "2"}, {"3", ""}, {"4", "5"}}));
  EXPECT_EQ(table.column("b"), 1u);
  EXPECT_FALSE(table.column("c"));
  EXPECT_TRUE(parse_csv("").columns.empty());
  EXPECT_FALSE(hyperlattice::csv_number("1 "));
  EXPECT_FALSE(hyperlattice::csv_number("inf"));
  EXPECT_EQ(hyperlattice::csv_number("-1e-3"), -1e-3);
}

}  // namespace study_numbers_test
