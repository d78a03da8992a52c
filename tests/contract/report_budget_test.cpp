// The size of the page with the body in 3D.
#include <gtest/gtest.h>
#include <support/report.hpp>

namespace hyperlattice::test {
namespace report_budget_test {

using ReportBudget = ReportCommand;

/// A particle costs two bytes for each number of each frame and for its place at rest, as base64
/// text, and nothing else.
TEST_F(ReportBudget, BytesOfAParticle) {
  constexpr double frames = 6, numbers = 4, places = 3, text_of_number = 2 * 4.0 / 3;
  constexpr double budget = (places + frames * numbers) * text_of_number;  // bytes
  double particles[2] = {}, bytes[2] = {};
  for (const int n : {0, 1}) {
    const std::string name = n == 0 ? "coarse" : "fine";
    run(name, {{"/pipeline/0/spacing", n == 0 ? "1 mm" : "0.5 mm"},
               {"/pipeline/5",
                {{"type", "writers.vtu"},
                 {"every", "2 us"},
                 {"fields", {"displacement", "von_mises"}}}}});
    const Result made = report({out(name), "--interactive"});
    if (made.exit_code == 4) GTEST_SKIP() << made.err;
    ASSERT_EQ(made.exit_code, 0) << made.err;
    particles[n] = read_json(out(name) + "/summary.json")["particles"];
    bytes[n] = static_cast<double>(std::filesystem::file_size(out(name) + "/report.html"));
  }
  ASSERT_GT(particles[1], 4 * particles[0]);
  const double each = (bytes[1] - bytes[0]) / (particles[1] - particles[0]);
  EXPECT_LE(each, 1.01 * budget);
  EXPECT_GE(each, 0.5 * budget);                     // the numbers are in the page
  EXPECT_LE(bytes[0] - each * particles[0], 1.2e6);  // three.js, plots and texts
}

}  // namespace report_budget_test
}  // namespace hyperlattice::test
