// Quantities with units: values against the definitions of the units, and refusals with a reason.
#include <quantities/units.hpp>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <atomic>
#include <charconv>
#include <clocale>
#include <cmath>
#include <thread>

namespace units_test {
using namespace hyperlattice;

double si(std::string_view text, std::string_view unit) {
  const Quantity quantity = read_quantity(text, unit);
  EXPECT_EQ(quantity.problem, "") << text;
  return quantity.value;
}
std::string problem(std::string_view text, std::string_view unit) {
  return read_quantity(text, unit).problem;
}

TEST(Units, ScalesOfTheInternationalSystem) {
  EXPECT_EQ(si("1 mm", "m"), 0.001);
  EXPECT_EQ(si("3.5e-3 mm", "m"), 3.5e-6);
  EXPECT_EQ(si("  20mm ", "m"), 0.02);
  EXPECT_EQ(si("200 MPa", "Pa"), 200e6);
  EXPECT_EQ(si("10 GPa", "Pa"), 1e10);
  EXPECT_EQ(si("5 us", "s"), 5e-6);
  EXPECT_EQ(si("5 µs", "s"), 5e-6);
  EXPECT_EQ(si("2.5 g/cm3", "kg/m3"), 2500);
  EXPECT_EQ(si("2500 kg m-3", "kg/m3"), 2500);
  EXPECT_EQ(si("5 kHz", "1/s"), 5000);
  EXPECT_EQ(si("5 1/s", "1/s"), 5);
  EXPECT_EQ(si("-1.5 kN", "N"), -1500);
  EXPECT_EQ(si("+2 m", "m"), 2);
  EXPECT_EQ(si(".5 m", "m"), 0.5);
  EXPECT_EQ(si("1 N/mm", "N/m"), 1000);
  EXPECT_EQ(si("0e99999999999 mm", "m"), 0);
}

TEST(Units, OtherUnitsByTheirDefinitions) {
  EXPECT_DOUBLE_EQ(si("1 inch", "m"), 0.0254);
  EXPECT_DOUBLE_EQ(si("2 hours", "s"), 7200);
  EXPECT_DOUBLE_EQ(si("1 atm", "Pa"), 101325);
  EXPECT_DOUBLE_EQ(si("180 degrees", "rad"), std::acos(-1.0));
  EXPECT_EQ(si("20 %", ""), 0.2);
}

// The value is the double nearest to the text, as if the text were in SI.
TEST(Units, PowersOfTenAreExact) {
  EXPECT_TRUE(rc::check([] {
    const auto mantissa = *rc::gen::inRange<std::int64_t>(-1'000'000'000'000, 1'000'000'000'000);
    const int exponent = *rc::gen::inRange(-40, 40);
    const std::vector<std::pair<std::string, int>> prefixes{
        {"k", 3}, {"M", 6}, {"G", 9}, {"m", -3}, {"u", -6}, {"n", -9}, {"c", -2}};
    const auto [prefix, power] = *rc::gen::elementOf(prefixes);
    const std::string digits = std::to_string(mantissa) + "e",
                      truth = digits + std::to_string(exponent + power);
    double expected = 0;
    std::from_chars(truth.data(), truth.data() + truth.size(), expected);
    RC_ASSERT(read_quantity(digits + std::to_string(exponent) + ' ' + prefix + 'm', "m").value ==
              expected);
  }));
}

TEST(Units, RefusalsSayWhy) {
  EXPECT_EQ(problem("200 MPaa", "Pa"), "unknown unit \"MPaa\"");
  EXPECT_EQ(problem("5 s", "m"), "it is a time");
  EXPECT_EQ(problem("5 N/m", "m"), "it is a stiffness");
  EXPECT_EQ(problem("5 m7", "m"), "it is a quantity in m7");
  EXPECT_EQ(problem("5 s", "1/s"), "it is a time");  // not 0.2 per second
  EXPECT_EQ(problem("5", "m"), "it has no unit; a plain number without quotation marks is SI");
  EXPECT_EQ(problem("5", ""), "write a plain number without quotation marks");
  EXPECT_EQ(problem("mm", "m"), "it does not begin with a number");
  EXPECT_EQ(problem("", "m"), "it does not begin with a number");
  EXPECT_EQ(problem("nan m", "m"), "it is not finite");
  EXPECT_EQ(problem("inf m", "m"), "it is not finite");
  EXPECT_EQ(problem("1e400 m", "m"), "the number is too large or too small for double precision");
  EXPECT_EQ(problem("1e305 Gm", "m"), "the number is too large or too small for double precision");
  EXPECT_EQ(problem("5 100 m", "m"), "a number stands where the unit should be: \"100 m\"");
  EXPECT_EQ(problem("5 seconds since 2000-01-01", "s"),
            "a number stands after the unit: \"2000-01-01\"");
  EXPECT_NE(problem("5 lg(re 1 m)", "m"), "");
  EXPECT_NE(problem(std::string_view("5 mm\0m", 7), "m"), "");
  EXPECT_NE(problem("5 " + std::string(100'000, 'm'), "m"), "");
}

TEST(Units, NothingStandsAfterTheUnit) {
  EXPECT_EQ(problem("10 GPa 5 %", "Pa"), "a number stands after the unit: \"5 %\"");
  EXPECT_EQ(problem("10 GPa 2", "Pa"), "a number stands after the unit: \"2\"");
  EXPECT_EQ(problem("2500 kg/m3 0.5", "kg/m3"), "a number stands after the unit: \"0.5\"");
  EXPECT_EQ(problem("1 mm 2", "m"), "a number stands after the unit: \"2\"");
  EXPECT_EQ(problem("1 mm -2", "m"), "a number stands after the unit: \"-2\"");
  EXPECT_EQ(problem("1 mm + 2", "m"), "\"+\" is no part of a unit");
  EXPECT_EQ(problem("1 mm, 2", "m"), "\",\" is no part of a unit");
  EXPECT_EQ(problem("10'000 MPa", "Pa"),
            "\"'\" stands in the number: it has a decimal point, and nothing between thousands");
  EXPECT_EQ(problem("1,5 mm", "m"),
            "\",\" stands in the number: it has a decimal point, and nothing between thousands");
  for (const char* bad :
       {"1 000 MPa", "10_000 MPa",    "10 GPa'", "10 GPa GPa", "10 2/m Pa m", "10 GPa @ 3",
        "10 GPa:",   "10 Pa s-1 s 1", "10 (GPa", "10 GPa)",    "10 Pa^",      "10 Pa^-",
        "10 Pa0",    "10 Pa^1.5",     "10 Pa99", "10 Pa m/",   "10 /m",       "10 Pa..m/m",
        "10 ((Pa))", "10 N/(m",       "10 N/()", "10 1/",      "10 1 Pa",     "10 lg(re 1 Pa)"})
    EXPECT_NE(problem(bad, "Pa"), "") << bad;
}

TEST(Units, NoPercentStandsBehindAUnit) {
  EXPECT_EQ(problem("10 GPa %", "Pa"), "\"%\" stands behind a unit");
  EXPECT_EQ(problem("10 GPa.percent", "Pa"), "\"percent\" stands behind a unit");
  EXPECT_DOUBLE_EQ(si("5 %/s", "1/s"), 0.05);
  EXPECT_EQ(problem("1_000 MPa", "Pa"),
            "\"_\" stands in the number: it has a decimal point, and nothing between thousands");
}

TEST(Units, UnknownOnesThatAreMeantToBeKnown) {
  EXPECT_EQ(problem("10 gpa", "Pa"), "unknown unit \"gpa\"; did you mean \"GPa\"?");
  EXPECT_EQ(problem("10 Gpa", "Pa"), "unknown unit \"Gpa\"; did you mean \"GPa\"?");
  EXPECT_EQ(problem("90 deg", "rad"), "unknown unit \"deg\"; did you mean \"degrees\"?");
}

TEST(Units, ProductsQuotientsAndPowers) {
  for (const char* same :
       {"3 kg/m3", "3 kg m-3", "3 kg.m^-3", "3 kg*m**-3", "3 kg\u00B7m\u207B\u00B3",
        "3 kg / m\u00B3", "3 kg/m/m/m", "3 kg/(m m m)", "3 kg/(m.m2)", "3kg/m^3", "3 (kg m)/m4"})
    EXPECT_DOUBLE_EQ(si(same, "kg/m3"), 3) << same;
  EXPECT_DOUBLE_EQ(si("3 1/s", "1/s"), 3);
  EXPECT_DOUBLE_EQ(si("3 1/(s m)", "Pa s/kg"), 3);
  EXPECT_EQ(problem("3 kg/m s2", "Pa"),
            "after \"/\" a product stands in parentheses, as in \"kg/(m s2)\"");
  EXPECT_DOUBLE_EQ(si("3 kg/(m s2)", "Pa"), 3);
}

TEST(Units, ASymbolHasOnePrefixAndBeginsAtZero) {
  EXPECT_EQ(problem("1 mmm", "m"), "unknown unit \"mmm\"");
  EXPECT_EQ(problem("1 kMPa", "Pa"), "unknown unit \"kMPa\"");
  EXPECT_DOUBLE_EQ(si("1 micrometre", "m"), 1e-6);
  EXPECT_DOUBLE_EQ(si("1 dam", "m"), 10);
  EXPECT_DOUBLE_EQ(si("1 \u03BCm", "m"), 1e-6);
  EXPECT_EQ(problem("25 degC", "K"), "\"degC\" does not begin at zero, or is a logarithm");
  EXPECT_NE(problem("25 \u00B0F", "K"), "");
}

TEST(Units, AnglesAreNotDropped) {
  EXPECT_EQ(problem("60 rpm", "Hz"), "it is an angular velocity");
  EXPECT_EQ(problem("1 cycle/s", "Hz"), "it is an angular velocity");
  EXPECT_EQ(problem("10 rad/s", "Hz"), "it is an angular velocity");
  EXPECT_EQ(problem("10 Hz", "rad/s"), "it is a rate");
  EXPECT_EQ(problem("10 1/s", "rad/s"), "it is a rate");
  EXPECT_EQ(problem("90 degrees", ""), "it is an angle");
  EXPECT_EQ(problem("5 %", "rad"), "it is a number");
  EXPECT_DOUBLE_EQ(si("60 rpm", "rad/s"), 2 * std::acos(-1.0));
  EXPECT_DOUBLE_EQ(si("180 degrees/s", "rad/s"), std::acos(-1.0));
  EXPECT_EQ(si("60 1/min", "Hz"), 1);
}

TEST(Units, BlanksThatNobodySees) {
  EXPECT_EQ(si("1\u00A0mm", "m"), 0.001);
  EXPECT_EQ(si("1\u202Fmm\u00A0", "m"), 0.001);
  EXPECT_EQ(si("3 Pa\u00A0s", "Pa s"), 3);
  EXPECT_EQ(problem("1 \u200Bmm", "m"), "\"U+200B\" is no part of a unit");
  EXPECT_EQ(problem(std::string_view("1 m\0m", 5), "m"), "\"U+0000\" is no part of a unit");
}

TEST(Units, DimensionsHaveNames) {
  EXPECT_EQ(dimension_of("m").name, "a length");
  EXPECT_EQ(dimension_of("Pa").name, "a pressure");
  EXPECT_EQ(dimension_of("J/m2").name, "an energy per area");
  EXPECT_EQ(dimension_of("N/m").name, "a stiffness");
  EXPECT_EQ(dimension_of("mm").name, "a length");
  EXPECT_EQ(dimension_of("").name, "a number");
  EXPECT_EQ(dimension_of("m7").example, "1 m7");
  for (const char* unit : {"m",     "s", "kg", "K", "rad", "m2",  "m3",   "1/s",  "m/s",  "m/s2",
                           "kg/m3", "N", "Pa", "J", "W",   "N/m", "J/m2", "Pa s", "kg/s", "rad/s"})
    EXPECT_EQ(problem(dimension_of(unit).example, unit), "")
        << unit;  // each example is a valid value
}

TEST(Units, TheLocaleDoesNotMatter) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8"})
    if (std::setlocale(LC_ALL, name) != nullptr) {
      EXPECT_EQ(si("1.5 mm", "m"), 0.0015);
      EXPECT_EQ(si("1.5 inch", "m"), 0.0381);
    }
  std::setlocale(LC_ALL, before.c_str());
}

TEST(Units, ThreadsMayReadAtTheSameTime) {
  std::vector<std::thread> threads;
  std::atomic<int> right = 0;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] {
      for (int n = 0; n < 500; ++n)
        right +=
            read_quantity("2 mm", "m").value == 0.002 && dimension_of("Pa").name == "a pressure";
    });
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(right, 2000);
}

}  // namespace units_test
