// Every component of the project keeps the contract of its family. The contract finds plugins that
// break it and says what is wrong.
#include <contract/contract.hpp>
#include <contract/lone_spring.hpp>
#include <contract/scenes.hpp>
#include <support/components.hpp>
#include <support/program.hpp>

#include <gtest/gtest.h>

#include <limits>

namespace hyperlattice::test {
namespace contract_test {

using contract::Check;
using contract::Verdict;

Host& host() {
  static Host host({std::string(HYPERLATTICE_BUILD) + "/lib/hyperlattice"});
  return host;
}

class Contract : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Components, Contract, testing::ValuesIn(host().known_types()),
                         [](const auto& info) {
                           std::string name = info.param;
                           std::replace(name.begin(), name.end(), '.', '_');
                           return name;
                         });

TEST_P(Contract, IsKept) {
  const Component* component = host().find(GetParam());
  ASSERT_NE(component, nullptr) << host().why_not(GetParam());
  std::size_t passed = 0;
  for (const Check& check : contract::check(*component, host(), around)) {
    EXPECT_NE(check.verdict, Verdict::failed) << check.name << ": " << check.detail;
    passed += check.verdict == Verdict::passed ? 1 : 0;
  }
  if (GetParam() != "lattices.points") {  // its example needs a file
    EXPECT_GE(passed, 2u);
  }
}

// A whole number that fits in 64 bits may not fit where it is used.
TEST_P(Contract, WholeNumbersHaveBothBounds) {
  const Component* component = host().find(GetParam());
  ASSERT_NE(component, nullptr) << host().why_not(GetParam());
  for (const Option& option : component->info.options)
    if (option.kind == OptionKind::integer) {
      EXPECT_GT(option.low, -infinity) << option.name;
      EXPECT_LT(option.high, infinity) << option.name;
    }
}

struct Wrong {
  const char *type, *check, *detail;
};
class WrongPlugin : public testing::TestWithParam<Wrong> {};
INSTANTIATE_TEST_SUITE_P(
    All, WrongPlugin,
    testing::Values(
        Wrong{"materials.wrong_force", "force is the derivative of the energy",
              "N, the slope of the energy"},
        Wrong{"materials.wrong_force", "dissipation is never negative",
              "given back out of nothing"},
        Wrong{"failures.late_alarm", "alarm is conservative", "below its alarm of 2e-06 m"},
        Wrong{"writers.careless", "full disk", "a frame that cannot be written is no error"}));

TEST_P(WrongPlugin, IsToldWhatIsWrong) {
  const auto& [type, check, detail] = GetParam();
  const Result result = run_program(
      {"plugins", "--test", type, "--plugin-path", HYPERLATTICE_BUILD "/tests/wrong_plugins"});
  EXPECT_EQ(result.exit_code, 3) << result.err;
  const std::size_t line = result.out.find(std::string("  failed          ") + check + ": ");
  ASSERT_NE(line, std::string::npos) << result.out;
  EXPECT_NE(result.out.substr(line, result.out.find('\n', line) - line).find(detail),
            std::string::npos)
      << result.out;
  EXPECT_EQ(result.out.find(", 0 failed, "), std::string::npos);
}

// Comparisons with NaN are false. A law, load or criterion that returns NaN must still fail.
TEST(Numbers, WhatIsNoNumberIsLargerThanAll) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  double worst = 0;
  for (const double value : {1.0, none, -2.0, none, 3.0}) contract::take_largest(worst, value);
  EXPECT_EQ(worst, infinity);
  EXPECT_EQ(contract::largest({1, none, 2}), infinity);
  EXPECT_EQ(contract::distance({1, none}, {1, 0}), infinity);
  EXPECT_EQ(contract::largest({1, -3, 2}), 3);
  contract::MotionResult result;
  contract::take_largest(result.largest_error, none);
  EXPECT_FALSE(result.is_finite());
}

TEST(ContractCommand, CountsWhatItFound) {
  const Result one = run_program({"plugins", "--test", "probes.point", "failures.strain"});
  EXPECT_EQ(one.exit_code, 0) << one.err;
  EXPECT_NE(one.out.find("\n9 passed, 0 failed, 0 not applicable\n"), std::string::npos) << one.out;
  const nlohmann::json json =
      nlohmann::json::parse(run_program({"plugins", "--test", "failures.strain", "--json"}).out);
  EXPECT_EQ(json["passed"], 6);
  EXPECT_EQ(json["components"][0]["checks"].size(), 6u);
  EXPECT_EQ(run_program({"plugins", "--test", "failures.nothing"}).exit_code, 2);
}

TEST(ContractCommand, DrawsLaws) {
  const Folder folder("pictures");
  const Result result = run_program(
      {"plugins", "--test", "materials.plastic", "failures.strain", "--pictures", folder.path()});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(folder.names(), std::vector<std::string>{"materials.plastic.svg"});
}

// The picture must have known points in the right places.
TEST(Picture, PutsPointsWhereTheyBelong) {
  std::vector<contract::PathPoint> path(11);  // the picture shows every fifth point
  path[5].elongation = 2e-6;
  path[5].force = 10;
  path[10].elongation = -2e-6;
  path[10].force = -30;
  const std::string svg = contract::picture("a law", path);
  EXPECT_NE(svg.find("d=\"M234 88L404 32L64 256\""), std::string::npos) << svg;
  for (const char* text : {">a law<", ">-2<", ">2<", ">-30<", ">10<"})
    EXPECT_NE(svg.find(text), std::string::npos) << text;
}

}  // namespace contract_test
}  // namespace hyperlattice::test
