// Limits of a process: threads, processors and memory; and the fallback where a limit is reached.
#include "support/output.hpp"

#include <base/errors.hpp>
#include <base/named_file.hpp>
#include <process/control_group.hpp>
#include <process/processors.hpp>
#include <process/room.hpp>
#include <process/team.hpp>
#include <state/layout.hpp>

#include <gtest/gtest.h>

#include <sys/stat.h>

#include <fstream>
#include <set>
#include <thread>

namespace hyperlattice {
namespace process_test {

class FakeRoot : public testing::Test {
 protected:
  void write(const std::string& file, const std::string& text) const {
    const std::filesystem::path path = folder_.file(file);
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << text;
  }
  std::filesystem::path root() const { return folder_.path(); }

  test::Folder folder_{"fake_root"};
};

TEST_F(FakeRoot, AGroupOfVersion2LimitsMemoryLessWhatTheKernelCanTakeBack) {
  write("proc/self/cgroup", "0::/jobs/one\n");
  write("proc/meminfo", "MemTotal:       8000000 kB\nMemAvailable:   7000000 kB\n");
  write("sys/fs/cgroup/jobs/one/memory.max", "600000000\n");
  write("sys/fs/cgroup/jobs/one/memory.current", "250000000\n");
  write("sys/fs/cgroup/jobs/one/memory.stat",
        "anon 100\ninactive_file 100000000\nactive_file 30000000\nslab_reclaimable 20000000\n");
  write("sys/fs/cgroup/jobs/memory.max", "max\n");
  write("sys/fs/cgroup/jobs/memory.current", "900000000\n");
  const Room room = memory_room(root());
  EXPECT_EQ(room.bytes, 500e6);
  EXPECT_NE(room.bound.find("jobs/one is 600 MB, 100 MB of it in use"), std::string::npos)
      << room.bound;

  write("sys/fs/cgroup/jobs/memory.max", "1000000000\n");  // the parent group has less memory left
  EXPECT_EQ(memory_room(root()).bytes, 100e6);
}

TEST_F(FakeRoot, AGroupOfVersion1LimitsMemoryAlsoFromWithinAContainer) {
  write("proc/self/cgroup", "5:cpu,cpuacct:/docker/1\n4:memory:/docker/1\n0::/\n");
  write("sys/fs/cgroup/memory/memory.limit_in_bytes",
        "300000000\n");  // in a container, the group's files are at the mount point
  write("sys/fs/cgroup/memory/memory.usage_in_bytes", "120000000\n");
  write("sys/fs/cgroup/memory/memory.stat",
        "cache 5\ntotal_inactive_file 20000000\ntotal_active_file 0\n");
  EXPECT_EQ(memory_room(root()).bytes, 200e6);
}

TEST_F(FakeRoot, WithoutGroupsTheMachineSetsTheLimit) {
  EXPECT_FALSE(ControlGroups(root()).memory().has_value());
  write("proc/self/cgroup", "garbage\n7:memory:/gone\n");
  write("proc/meminfo", "MemTotal:       4000 kB\nMemAvailable:   1000 kB\n");
  EXPECT_EQ(memory_room(root()).bytes, 1024e3);
}

TEST_F(FakeRoot, AGroupGrantsPartOfTheProcessors) {
  EXPECT_GE(processors(root()), 1);
  EXPECT_LE(processors(root()), static_cast<int>(std::thread::hardware_concurrency()));
  write("proc/self/cgroup", "0::/one\n");
  write("sys/fs/cgroup/one/cpu.max", "max 100000\n");
  EXPECT_FALSE(ControlGroups(root()).processors().has_value());
  write("sys/fs/cgroup/one/cpu.max", "50000 100000\n");
  EXPECT_EQ(ControlGroups(root()).processors(), 0.5);
  EXPECT_EQ(processors(root()), 1);
}

TEST(Team, SharesAllWorkOnce) {
  for (const int threads : {1, 2, 3, 7}) {
    Team team(threads);
    EXPECT_EQ(team.count(), threads);
    for (const std::size_t size : {0U, 1U, 2U, 5U, 1000U}) {
      std::vector<int> count(size, 0);
      for (int round = 0; round < 2000; ++round)
        team.for_each(size, [&](std::size_t n) { ++count[n]; });
      EXPECT_EQ(count, std::vector<int>(size, 2000));
    }
  }
}

TEST(Team, GivesWorkOfItsOwnToTheSameThreadEachTime) {
  for (const int threads : {1, 2, 3, 7}) {
    Team team(threads);
    for (const std::size_t size : {0U, 1U, 2U, 5U, 1000U}) {
      std::vector<std::thread::id> first(size), second(size);
      std::vector<int> count(size, 0);
      team.for_own(size, [&](std::size_t n) { first[n] = std::this_thread::get_id(); });
      for (int round = 0; round < 50; ++round)
        team.for_own(size, [&](std::size_t n) {
          ++count[n];
          second[n] = std::this_thread::get_id();
        });
      EXPECT_EQ(count, std::vector<int>(size, 50));
      EXPECT_EQ(first, second);
      if (size == 1000) {
        EXPECT_EQ(std::set(first.begin(), first.end()).size(), static_cast<std::size_t>(threads));
      }
    }
  }
}

TEST(Team, WaitsForNoThreadThatHasBegunNothing) {
  Team team(2);
  std::atomic<bool> all = false;
  std::atomic<int> count = 0;
  team.for_each(4, [&](std::size_t n) {
    // Here the range of the second thread begins. One thread waits until the other has done the
    // rest.
    if (n == 2)
      for (int look = 0; !all && look < 10'000; ++look)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (++count == 3) all = true;
  });
  EXPECT_TRUE(all);
  EXPECT_EQ(count, 4);
}

TEST(Team, ThrowsTheFirstOfSeveralErrors) {
  for (const int threads : {1, 2, 3}) {
    Team team(threads);
    for (int round = 0; round < 200; ++round) try {
        team.for_each(9, [](std::size_t n) {
          if (n % 3 == 2) throw std::runtime_error(std::to_string(n));
        });
        FAIL();
      } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "2");
      }
  }
}

TEST(Team, ThrowsWhatWorkThrowsAndGoesOn) {
  Team team(3);
  for (const std::size_t bad : {0U, 4U, 8U}) {
    EXPECT_THROW(team.for_each(9,
                               [&](std::size_t n) {
                                 if (n == bad) throw std::bad_alloc();
                               }),
                 std::bad_alloc);
    std::atomic<int> done = 0;
    team.for_each(9, [&](std::size_t) { ++done; });
    EXPECT_EQ(done, 9);
  }
}

TEST(Layout, RefusesMoreRowsThanKernelsCount) {
  Model model;
  model.body.grid.sites = {1, 2'000'000'000, 1};
  EXPECT_THROW(make_layout(model, 1), OutsideError);
  model.body.grid.sites = {2'147'483'640, 1, 1};
  EXPECT_THROW(make_layout(model, 1), OutsideError);
}

TEST(NamedFile, WritesIntoWhatIsNoFileAndReplacesNothing) {
  const test::Folder folder("named_file");
  std::ofstream(folder.file("target")) << "a longer text than the new one";
  std::filesystem::create_symlink("target", folder.file("link"));
  write_named_file(folder.file("link"), "page");
  EXPECT_TRUE(std::filesystem::is_symlink(folder.file("link")));
  EXPECT_EQ(test::contents(folder.file("target")), "page");

  ASSERT_EQ(mkfifo(folder.file("pipe").c_str(), 0600), 0);
  std::string read;
  std::thread reader([&] { read = test::contents(folder.file("pipe")); });
  write_named_file(folder.file("pipe"), "through the pipe");
  reader.join();
  EXPECT_EQ(read, "through the pipe");
  EXPECT_TRUE(std::filesystem::is_fifo(folder.file("pipe")));

  std::filesystem::create_symlink("/dev/full", folder.file("full"));
  EXPECT_THROW(write_named_file(folder.file("full"), "x"), OutsideError);
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
  std::filesystem::create_symlink("nowhere", folder.file("dangling"));
  EXPECT_THROW(write_named_file(folder.file("dangling"), "x"), OutsideError);
  EXPECT_FALSE(std::filesystem::exists(folder.file("nowhere")));
}

}  // namespace process_test
}  // namespace hyperlattice
