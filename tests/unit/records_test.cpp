// A file of records is read exactly as written, or refused.
#include <run/records.hpp>
#include <state/archive.hpp>

#include <gtest/gtest.h>

#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numeric>
#include <random>

namespace records_test {
using namespace hyperlattice;

class Records : public testing::Test {
 protected:
  Records() { std::filesystem::create_directories(folder); }
  ~Records() override { std::filesystem::remove_all(folder); }

  std::string written(char first) const {
    AtomicFile file(path);
    RecordWriter records(file);
    std::vector<char> content(3'000'000);
    std::iota(content.begin(), content.end(), first);
    records.put("head", "a head", 6);
    records.put("stat", content.data(), content.size());
    records.put("stat", "more", 4);
    records.end();
    file.commit();
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  bool is_whole(const std::string& bytes) const {
    std::ofstream(path, std::ios::binary) << bytes;
    try {
      RecordReader::verify(path);
      return true;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(path), std::string::npos);
      return false;
    }
  }

  std::string folder = testing::TempDir() + "/hyperlattice_records_" + std::to_string(::getpid()),
              path = folder + "/records";
};

/// The offset of each record, then the end.
std::vector<std::size_t> starts_of(const std::string& bytes) {
  std::vector<std::size_t> starts;
  for (std::size_t place = 16; place < bytes.size();) {
    starts.push_back(place);
    std::uint32_t size = 0;
    std::memcpy(&size, &bytes[place + 4], sizeof size);
    place += 24 + size;
  }
  starts.push_back(bytes.size());
  return starts;
}

TEST_F(Records, ReadBackAsTheyWereWritten) {
  const std::string bytes = written(5);
  EXPECT_TRUE(is_whole(bytes));
  RecordReader records(path);
  EXPECT_EQ(records.take_all("head"), "a head");
  std::vector<char> content(3'000'004);
  records.take("stat", content.data(), 17);
  EXPECT_EQ(content[3], 8);
  records.take("stat", content.data(), 3'000'000 - 17);
  EXPECT_THROW(records.take("othr", content.data(), 1), std::runtime_error);
  records.take("stat", content.data(), 4);
  EXPECT_EQ(std::string(content.data(), 4), "more");
  EXPECT_THROW(records.take("stat", content.data(), 1), std::runtime_error);
}

TEST_F(Records, AnyChangeIsFound) {
  const std::string bytes = written(5), other = written(5);
  const auto starts = starts_of(bytes);
  ASSERT_EQ(starts.size(), 6u);  // head, three megabytes, end record, end of file
  ASSERT_EQ(starts_of(other), starts);
  std::mt19937 random(1);
  const auto below = [&](std::size_t n) { return random() % n; };
  for (int n = 0; n < 200; ++n) {
    std::string changed = bytes;
    changed[below(n % 2 == 0 ? 64 : bytes.size())] ^= static_cast<char>(1 << below(8));
    EXPECT_FALSE(is_whole(changed));
    EXPECT_FALSE(is_whole(bytes.substr(0, n % 2 == 0 ? below(64) : below(bytes.size()))));
  }
  const auto record = [&](const std::string& from, std::size_t n) {
    return from.substr(starts[n], starts[n + 1] - starts[n]);
  };
  for (std::size_t a = 0; a + 1 < starts.size(); ++a) {
    for (std::size_t b = 0; b + 1 < starts.size(); ++b) {
      std::string swapped = bytes.substr(0, 16), twice = swapped;
      for (std::size_t n = 0; n + 1 < starts.size(); ++n) {
        swapped += record(bytes, n == a ? b : n == b ? a : n);
        twice += record(bytes, n) + (n == a ? record(bytes, b) : "");
      }
      EXPECT_EQ(is_whole(swapped), a == b);
      EXPECT_FALSE(is_whole(twice));
    }
    std::string gone = bytes, foreign = bytes, resized = bytes;
    gone.erase(starts[a], starts[a + 1] - starts[a]);
    EXPECT_FALSE(is_whole(gone));
    EXPECT_FALSE(is_whole(foreign.replace(starts[a], starts[a + 1] - starts[a], record(other, a))))
        << "of another file, though all else agrees";
    const std::uint32_t size = static_cast<std::uint32_t>(random());
    std::memcpy(&resized[starts[a] + 4], &size, sizeof size);
    EXPECT_FALSE(is_whole(resized));
  }
  EXPECT_FALSE(is_whole(bytes + '\0'));
  EXPECT_FALSE(is_whole(bytes + bytes));
  EXPECT_TRUE(is_whole(bytes));
}

TEST(Archive, AllocatesNoMoreThanItHolds) {
  std::size_t asked = 0;
  const std::uint64_t size = ~std::uint64_t{0} / 16;
  Archive archive(
      [&](void* data, std::size_t bytes) {
        if (asked++ > 0) throw std::runtime_error("nothing more");
        ASSERT_EQ(bytes, sizeof size);
        std::memcpy(data, &size, bytes);
      },
      true);
  std::vector<double> values;
  EXPECT_THROW(archive(values), std::runtime_error);
  EXPECT_LE(values.size(), std::size_t{1} << 17);
}

}  // namespace records_test
