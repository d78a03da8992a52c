#include <run/records.hpp>

#define XXH_INLINE_ALL  // nothing to link
#include <xxhash.h>

#include <spdlog/fmt/fmt.h>

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <random>
#include <stdexcept>

namespace hyperlattice {

namespace {

constexpr std::size_t largest = 1 << 20;  // bytes of one record's content
constexpr std::string_view mark = "HLRECORD", last_tag = "end.";

struct Head {
  char tag[4];
  std::uint32_t size;
  std::uint64_t number, checksum;
};
static_assert(sizeof(Head) == 24);

std::uint64_t checksum(const Head& head, const char* content, std::uint64_t nonce) {
  return XXH3_64bits_withSeed(content, head.size,
                              XXH3_64bits_withSeed(&head, offsetof(Head, checksum), nonce));
}

}  // namespace

RecordWriter::RecordWriter(AtomicFile& file) : file_(file) {
  std::random_device source;
  nonce_ = std::uint64_t{source()} << 32 | source();
  file_.write(mark);
  file_.write({reinterpret_cast<const char*>(&nonce_), sizeof nonce_});
}

void RecordWriter::put(std::string_view tag, const void* data, std::size_t size) {
  if (tag != tag_) {
    flush();
    tag_ = tag;
  }
  const char* bytes = static_cast<const char*>(data);
  while (size > 0) {
    const std::size_t count = std::min(size, largest - content_.size());
    content_.insert(content_.end(), bytes, bytes + count);
    bytes += count;
    size -= count;
    if (content_.size() == largest) flush();
  }
}

void RecordWriter::flush() {
  if (content_.empty() && tag_ != last_tag) return;
  Head head{};
  std::copy_n(tag_.begin(), sizeof head.tag, head.tag);
  head.size = static_cast<std::uint32_t>(content_.size());
  head.number = number_++;
  head.checksum = checksum(head, content_.data(), nonce_);
  file_.write({reinterpret_cast<const char*>(&head), sizeof head});
  file_.write({content_.data(), content_.size()});
  content_.clear();
}

void RecordWriter::end() {
  flush();
  tag_ = last_tag;
  flush();
}

void RecordReader::verify(const std::filesystem::path& file) {
  RecordReader reader(file);
  while (reader.next()) {
  }
}

RecordReader::RecordReader(std::filesystem::path file)
    : path_(std::move(file)),
      file_(::open(path_.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC)) {
  if (!file_) fail(std::generic_category().message(errno));
  struct stat status {};
  if (::fstat(file_.number(), &status) != 0 || !S_ISREG(status.st_mode)) fail("no regular file");
  char there[8];
  static_assert(sizeof there == mark.size());
  read(there, sizeof there);
  if (std::string_view(there, sizeof there) != mark) fail("no file of records");
  read(&nonce_, sizeof nonce_);
}

bool RecordReader::next() {
  Head head{};
  read(&head, sizeof head);
  if (head.size > largest || head.number != number_)
    fail(fmt::format("damaged in record {}", number_));
  content_.resize(head.size);
  read(content_.data(), head.size);
  if (checksum(head, content_.data(), nonce_) != head.checksum)
    fail(fmt::format("damaged in record {}", number_));
  ++number_;
  used_ = 0;
  tag_.assign(head.tag, sizeof head.tag);
  if (tag_ != last_tag) return true;
  char more = 0;
  if (::read(file_.number(), &more, 1) != 0) fail("damaged: more follows than was written");
  return false;
}

void RecordReader::take(std::string_view tag, void* data, std::size_t size) {
  char* bytes = static_cast<char*>(data);
  while (size > 0) {
    if (used_ == content_.size()) {
      if (tag_ == last_tag || !next()) fail("it holds less than was expected");
    }
    if (tag_ != tag) fail(fmt::format("it holds \"{}\" where \"{}\" was expected", tag_, tag));
    const std::size_t count = std::min(size, content_.size() - used_);
    std::memcpy(bytes, content_.data() + used_, count);
    used_ += count;
    bytes += count;
    size -= count;
  }
}

std::string RecordReader::take_all(std::string_view tag) {
  std::string text;
  while (used_ < content_.size() || (tag_ != last_tag && next())) {
    if (tag_ != tag) break;
    text.append(content_.data() + used_, content_.size() - used_);
    used_ = content_.size();
  }
  return text;
}

void RecordReader::read(void* data, std::size_t size) {
  char* bytes = static_cast<char*>(data);
  while (size > 0) {
    const ssize_t count = ::read(file_.number(), bytes, size);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(std::generic_category().message(errno));
    if (count == 0) fail("cut off");
    bytes += count;
    size -= static_cast<std::size_t>(count);
  }
}

void RecordReader::fail(const std::string& what) const {
  throw std::runtime_error(fmt::format("{}: {}", path_.string(), what));
}

}  // namespace hyperlattice
