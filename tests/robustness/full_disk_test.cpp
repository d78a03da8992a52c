// The disk becomes full in the middle of a run: the message is clear, no incomplete file has a
// final name, and earlier frames stay.
#include <contract/small_disk.hpp>
#include <support/output.hpp>

#include <hyperlattice/files.hpp>

#include <gtest/gtest.h>

#include <functional>

namespace hyperlattice::test {
namespace full_disk_test {

using contract::SmallDisk;

std::string message_of(const std::function<void()>& code) {
  try {
    code();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(AtomicFile, ReplacesOnlyWhenWhole) {
  Folder folder("atomic");
  write_file(folder.file("a"), "old");
  {
    AtomicFile file(folder.file("a"));
    file.write("new");
    EXPECT_EQ(contents(folder.file("a")), "old");
  }
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a"});
  EXPECT_EQ(contents(folder.file("a")), "old");
  write_file(folder.file("a"), "new");
  EXPECT_EQ(contents(folder.file("a")), "new");
}

TEST(AtomicFile, SaysWhyTheSystemRefuses) {
  Folder folder("atomic_full");
  EXPECT_EQ(message_of([&] { write_file(folder.file("no/such/a"), "x"); }),
            "cannot create " + folder.file("no/such/a") + ": No such file or directory");
  const SmallDisk full(0);
  EXPECT_EQ(message_of([&] { write_file(folder.file("a"), "x"); }),
            "cannot write " + folder.file("a") + ": File too large");
  EXPECT_TRUE(folder.names().empty());
}

TEST(AtomicFile, FollowsNoLinkAndReplacesOnlyRegularFiles) {
  Folder folder("atomic_link");
  write_file(folder.file("victim"), "precious");
  // A predictable temporary name would follow this link.
  std::filesystem::create_symlink(folder.file("victim"), folder.file("a.part"));
  std::filesystem::create_symlink(folder.file("victim"), folder.file("link"));
  std::filesystem::create_directory(folder.file("folder"));
  ASSERT_EQ(mkfifo(folder.file("pipe").c_str(), 0600), 0);
  write_file(folder.file("a"), "x");
  EXPECT_EQ(contents(folder.file("a")), "x");
  for (const char* name : {"link", "folder", "pipe"})
    EXPECT_NE(message_of([&] {
                write_file(folder.file(name), "x");
              }).find("cannot create " + folder.file(name)),
              std::string::npos)
        << name;
  EXPECT_EQ(contents(folder.file("victim")), "precious");
  EXPECT_EQ(folder.names(),
            (std::vector<std::string>{"a", "a.part", "folder", "link", "pipe", "victim"}));
}

class FullDisk : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Types, FullDisk,
                         testing::Values("writers.vtu", "writers.cracks", "writers.csv",
                                         "writers.picture"));

TEST_P(FullDisk, LeavesEarlierFramesIntact) {
  Folder folder("full_disk");
  FakeBody body({20, 20, 20});
  Plugin writer(GetParam());
  writer.begin(body.context(folder.path()));
  writer.frame(body.at(0));
  const auto names = folder.names();
  std::vector<std::string> before;
  for (const std::string& name : names) before.push_back(contents(folder.file(name)));
  std::string refusal;
  {
    const SmallDisk full(4096);
    refusal = message_of([&] { writer.frame(body.at(1)); });
  }
  EXPECT_NE(refusal.find("_000001"), std::string::npos) << refusal;
  EXPECT_NE(refusal.find(": File too large"), std::string::npos) << refusal;
  EXPECT_EQ(folder.names(), names);
  for (std::size_t n = 0; n < names.size(); ++n)
    EXPECT_TRUE(contents(folder.file(names[n])) == before[n]) << names[n];
  writer.frame(body.at(2));  // the disk has room again: the series goes on
  EXPECT_EQ(folder.names().size(), names.size() + 1);
}

}  // namespace full_disk_test
}  // namespace hyperlattice::test
