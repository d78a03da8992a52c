// Energy that grows from nothing is found; energy that loads give, take back, or that steps near
// the critical one make, is not.
#include <engine/energy_growth.hpp>

#include <gtest/gtest.h>

#include <vector>

namespace energy_growth_test {
using namespace hyperlattice;

/// A balance without error.
EnergyBalance balance(double kinetic, double stored, double injected) {
  EnergyBalance made;
  made.kinetic = kinetic;
  made.stored = stored;
  made.injected = injected;
  return made;
}

/// An unstable mode: energies of both signs grow by `factor` from record to record, and their sum
/// is that at the start, 1 J. Returns the record at which it is found, of 40; 40: it is not.
int found_at(double factor, double step_ratio, double limit) {
  EnergyGrowth growth;
  double grown = 1e-3;
  for (int record = 0; record < 40; ++record, grown *= factor)
    if (growth.runs_away(balance(0.5 - grown, 0.5 + grown, 0), {}, step_ratio, limit))
      return record;
  return 40;
}

TEST(EnergyGrowth, IsFoundThoughTheBalanceCloses) {
  // The ratio is 0.5 + 1e-3 2^n in record n: it grows by half and more from record 10 on.
  EXPECT_EQ(found_at(2, 0, 2), 12);
  EXPECT_EQ(found_at(2, 0.5, 2), 12);
  EXPECT_EQ(found_at(2, 0.8, 2), 13);  // beyond 2 / (1 - 0.8^2)
  EXPECT_EQ(found_at(2, 0.5, 0), 40);
  EXPECT_GT(found_at(2, 0.99, 2), 15);
  EXPECT_EQ(found_at(1.2, 0, 2), 40) << "a slow growth may be a beat of waves";
}

TEST(EnergyGrowth, IsFoundAtOnceIfItIsHuge) {
  EnergyGrowth growth;
  EXPECT_FALSE(growth.runs_away(balance(1, 0, 1), std::vector{1.0}, 0.9, 2));
  EXPECT_TRUE(growth.runs_away(balance(-1e6, 1e6 + 1, 1), std::vector{1.0}, 0.9, 2));
  EXPECT_NEAR(growth.ratio(), 1e6, 2);
}

TEST(EnergyGrowth, IsNoneWhereLoadsTakeBackWhatTheyGave) {
  EnergyGrowth growth;
  for (int record = 0; record < 100; ++record) {
    const double given = record < 50 ? record : 99 - record, rest = 0.01 * record;  // errors of 1 %
    EnergyBalance now = balance(0.5 * given + rest, 0.5 * given, given);
    now.error = rest;
    EXPECT_FALSE(growth.runs_away(now, std::vector{given}, 0.9, 2)) << record;
  }
}

TEST(EnergyGrowth, IsNoneWhereStoredEnergyFallsBelowZero) {
  EnergyGrowth growth;
  double gained = 1e-6;
  for (int record = 0; record < 40; ++record, gained *= 3)
    EXPECT_FALSE(growth.runs_away(balance(gained, -gained, 0), {}, 0.9, 2)) << record;
}

TEST(EnergyGrowth, IsNoneWhereALoadWorksForAnotherThatTakes) {
  EnergyGrowth growth;
  double given = 1e-6;
  for (int record = 0; record < 40; ++record, given *= 3)
    EXPECT_FALSE(growth.runs_away(balance(0.6 * given, 0.3 * given, 0.9 * given),
                                  std::vector{given, -0.1 * given}, 0.9, 2))
        << record;
}

}  // namespace energy_growth_test
