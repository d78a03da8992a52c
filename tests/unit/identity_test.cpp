// Results depend on the contents of files: hashes of contents, and messages that name the change.
#include <base/content_hash.hpp>
#include <base/errors.hpp>
#include <base/folder_file.hpp>
#include <plan/identity.hpp>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <support/output.hpp>

#include <sys/stat.h>

namespace identity_test {
using namespace hyperlattice;
using Kind = Dependence::Kind;

Identity some_identity() {
  return {{Kind::scene, "/pipeline/0", {}, "a"},
          {Kind::file, "/regions/soft/voxels/file", "/here/body.raw", "b"},
          {Kind::plugin, "failures.mine", "/here/failures.mine.so", "c"},
          {Kind::program, "program", {}, "d"},
          {Kind::mode, "instruction set", {}, "baseline"}};
}

TEST(ContentHash, IsThatOfTheBytesHoweverTheyCome) {
  EXPECT_EQ(hash_of_text(""), "99aa06d3014798d86001c324468d497f") << "XXH3, 128 bits";
  ContentHash pieces;
  const std::string text(3000000, 'x');
  for (std::size_t n = 0; n < 3; ++n) pieces.add(std::string_view(text).substr(0, 1000000));
  const test::Folder folder("content_hash");
  std::ofstream(folder.file("text"), std::ios::binary) << text;
  EXPECT_EQ(pieces.text(), hash_of_text(text));
  EXPECT_EQ(hash_of_file(folder.file("text")), hash_of_text(text));
  EXPECT_NE(hash_of_text(text + " "), hash_of_text(text));
  EXPECT_THROW(hash_of_file(folder.file("none")), OutsideError);
}

TEST(Identity, NamesWhatChanged) {
  const Identity before = some_identity();
  EXPECT_EQ(changes(before, before), "");
  Identity moved = before;
  moved[1].path = "/elsewhere/other.raw";
  EXPECT_EQ(changes(before, moved), "") << "where a file stands does not count";
  EXPECT_EQ(identity_hash(before), identity_hash(moved));
  const auto changed = [&](std::size_t n) {
    Identity now = before;
    now[n].content = "avx2";
    EXPECT_NE(identity_hash(now), identity_hash(before));
    return changes(before, now);
  };
  EXPECT_EQ(changed(0), "/pipeline/0 has changed");
  EXPECT_EQ(changed(1), "body.raw (/regions/soft/voxels/file) has changed");
  EXPECT_EQ(changed(2), "the plugin failures.mine (/here/failures.mine.so) has changed");
  EXPECT_EQ(changed(3), "the program has changed");
  EXPECT_EQ(changed(4), "the instruction set is avx2 in place of baseline");
  Identity now = before;
  now.erase(now.begin() + 2);
  now[1].content = "x";
  EXPECT_EQ(changes(before, now),
            "body.raw (/regions/soft/voxels/file) has changed, and the plugin failures.mine "
            "(/here/failures.mine.so) is gone");
  EXPECT_EQ(changes({}, before),
            "/pipeline/0 is new, body.raw (/regions/soft/voxels/file) is new, the plugin "
            "failures.mine (/here/failures.mine.so) is new, and 2 more");
}

TEST(Identity, ComesBackFromItsJson) {
  const Identity identity = some_identity();
  EXPECT_EQ(changes(read_identity(identity_json(identity)), identity), "");
  EXPECT_EQ(read_identity(identity_json(identity))[1].path, identity[1].path);
  for (const char* wrong :
       {"null", "3", "{}", "[1]", "[{}]", "[{\"what\": 1}]", "[{\"what\": \"moon\"}]"})
    EXPECT_TRUE(read_identity(nlohmann::json::parse(wrong)).empty()) << wrong;
}

TEST(FolderFile, IsRegularAndInsideTheFolder) {
  const test::Folder folder("folder_file");
  std::filesystem::create_directory(folder.file("in"));
  std::ofstream(folder.file("secret")) << "secret";
  std::ofstream(folder.file("in/text")) << "0123456789";
  std::filesystem::create_symlink("../secret", folder.file("in/link"));
  std::filesystem::create_directory_symlink("..", folder.file("in/up"));
  ASSERT_EQ(mkfifo(folder.file("in/pipe").c_str(), 0600), 0);
  const std::filesystem::path in = folder.file("in");
  EXPECT_EQ(read_folder_file(in, "text", 10)->text, "0123456789");
  EXPECT_EQ(read_folder_file(in, "text", 4, true)->text, "0123");
  EXPECT_FALSE(read_folder_file(in, "text", 9)->refusal.empty()) << "too large";
  EXPECT_FALSE(read_folder_file(in, "none", 9));
  EXPECT_FALSE(read_folder_file(in, "text/none", 9));
  for (const char* name : {"link", "up/secret", "../secret", "/etc/passwd", "pipe", "."}) {
    const auto file = read_folder_file(in, name, 100);
    ASSERT_TRUE(file) << name;
    EXPECT_FALSE(file->refusal.empty()) << name;
    EXPECT_EQ(file->text, "") << name;
    EXPECT_FALSE(has_folder_file(in, name)) << name;
  }
  EXPECT_TRUE(has_folder_file(in, "text"));
}

}  // namespace identity_test
