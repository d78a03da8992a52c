// Tables grow by whole lines, and numbers keep all digits. Outputs are due at the steps nearest to
// their times.
#include <base/errors.hpp>
#include <process/file_limit.hpp>
#include <run/failure_log.hpp>
#include <run/history.hpp>
#include <run/progress.hpp>
#include <run/schedule.hpp>
#include <run/table.hpp>

#include <gtest/gtest.h>

#include <sys/resource.h>

#include <algorithm>
#include <clocale>
#include <fstream>
#include <iterator>
#include <limits>

namespace table_test {
using namespace hyperlattice;

std::filesystem::path fresh_folder(const std::string& name) {
  const auto folder = std::filesystem::path(testing::TempDir()) / ("hyperlattice_table_" + name);
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(Table, numbers_keep_every_digit_in_any_locale) {
  // In this locale, if the machine has it, the decimal point is a comma.
  std::setlocale(LC_ALL, "de_DE.UTF-8");
  const auto file = fresh_folder("digits") / "t.csv";
  const double values[] = {0.1, 1.0 / 3, -1e-300, std::numeric_limits<double>::max()};
  Table table(file, {"a", "b", "c", "d"});
  table.row(values);
  std::istringstream lines(text_of(file));
  std::string header, row;
  std::getline(lines, header);
  std::getline(lines, row);
  std::setlocale(LC_ALL, "C");
  EXPECT_EQ(header, "a,b,c,d");
  std::istringstream cells(row);
  for (const double value : values) {
    std::string cell;
    ASSERT_TRUE(std::getline(cells, cell, ','));
    EXPECT_EQ(std::stod(cell), value);
  }
}

TEST(Table, a_full_disk_leaves_whole_lines_and_says_so) {
  const auto file = fresh_folder("full") / "t.csv";
  const FileLimitGuard guard;
  struct rlimit before {};
  getrlimit(RLIMIT_FSIZE, &before);
  struct rlimit limit = before;
  limit.rlim_cur = 1003;
  setrlimit(RLIMIT_FSIZE, &limit);
  std::string message;
  try {
    Table table(file, {"time", "value"});
    std::string block;
    for (int n = 0; n < 7; ++n) block += "0.125,0.0625\n";
    for (int n = 0; n < 100; ++n) table.lines(block);
  } catch (const OutsideError& error) {
    message = error.what();
  }
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_NE(message.find("t.csv"), std::string::npos) << message;
  const std::string text = text_of(file);
  EXPECT_EQ(text.back(), '\n');
  EXPECT_GT(text.size(), 1003u - 13u);  // as many whole lines as fit
  EXPECT_LE(text.size(), 1003u);
}

TEST(Table, a_folder_that_is_not_there_is_an_outside_fault) {
  EXPECT_THROW(Table(fresh_folder("absent") / "no" / "t.csv", {"a"}), OutsideError);
}

TEST(FailureLog, writes_each_breakage_once) {
  const auto folder = fresh_folder("log");
  RunFolder run(folder, true);
  run.begin(false, {});
  FailureLog log(run);
  log.begin();
  std::vector<Breakage> breakages{{3, 0.5, 7, 8, 0, 1e-6}};
  log.write_new(breakages);
  breakages.push_back({4, 0.75, 1, 2, 1, 2e-6});
  log.write_new(breakages);
  log.write_new(breakages);
  EXPECT_EQ(text_of(folder / "failures.csv"),
            "step,time,particle_a,particle_b,elongation,softened\n"
            "3,0.5,7,8,1e-06,0\n4,0.75,1,2,2e-06,0\n");
}

TEST(History, keeps_the_latest_record_and_the_largest_error) {
  const auto folder = fresh_folder("history");
  RunFolder run(folder, true);
  run.begin(false, {});
  const Model model;
  History history(run, model);
  history.begin();
  EXPECT_FALSE(history.has(0));
  for (const double error : {0.1, -0.3, 0.2}) {
    Record record;
    record.step = history.last().step + 1;
    record.balance.error = error;
    record.balance.scale = 1;
    history.take(record);
    history.write({});
  }
  EXPECT_TRUE(history.has(3));
  EXPECT_FALSE(history.has(2));
  EXPECT_EQ(history.last().balance.error, 0.2);
  EXPECT_EQ(history.largest_relative_error(), 0.3);
  const std::string text = text_of(folder / "history.csv");
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 4);
}

TEST(Schedule, picks_the_step_nearest_to_each_instant) {
  Schedule schedule(0, 0.25, true);
  std::vector<double> seen;
  const double step = 0.01 * 1.1;
  for (int n = 0; n * step <= 1.01; ++n)
    if (schedule.due(n * step, step)) seen.push_back(n * step);
  ASSERT_EQ(seen.size(), 5u);
  for (std::size_t n = 0; n < seen.size(); ++n)
    EXPECT_NEAR(seen[n], 0.25 * static_cast<double>(n), 0.5 * step + 1e-12);
}

TEST(Schedule, shows_once_when_steps_are_longer_than_the_interval) {
  Schedule schedule(0, 0.01, true);
  for (int n = 0; n < 10; ++n) EXPECT_TRUE(schedule.due(n * 0.5, 0.5));
  EXPECT_FALSE(schedule.due(9 * 0.5, 0.5));
}

TEST(Schedule, without_an_interval_only_the_first) {
  Schedule schedule(0, 0, true), none(0, 0, false);
  EXPECT_TRUE(schedule.due(0, 1));
  EXPECT_FALSE(none.due(0, 1));
  for (int n = 1; n < 5; ++n) {
    EXPECT_FALSE(schedule.due(n, 1));
    EXPECT_FALSE(none.due(n, 1));
  }
}

TEST(Progress, writes_times_like_a_clock) {
  EXPECT_EQ(clock_time(0.4), "0:00");
  EXPECT_EQ(clock_time(59.6), "1:00");
  EXPECT_EQ(clock_time(3723), "1:02:03");
}

}  // namespace table_test
