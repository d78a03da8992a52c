// Tables are appended by system calls, because only these tell how much of a line reached the disk.
#include <base/errors.hpp>
#include <run/table.hpp>

#include <hyperlattice/files.hpp>

#include <spdlog/fmt/fmt.h>

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <iterator>
#include <system_error>

namespace hyperlattice {

namespace {

/// Adds the first bytes of a file to a hash. Returns 0 or the system's error; EIO if the file is
/// shorter.
int add_bytes(ContentHash& hash, const Descriptor& file, std::uint64_t bytes) {
  constexpr std::uint64_t piece = 1 << 18;
  std::vector<char> buffer(std::min(piece, bytes));
  for (std::uint64_t done = 0; done < bytes;) {
    const ssize_t count = ::pread(file.number(), buffer.data(), std::min(piece, bytes - done),
                                  static_cast<off_t>(done));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return count < 0 ? errno : EIO;
    hash.add({buffer.data(), static_cast<std::size_t>(count)});
    done += static_cast<std::uint64_t>(count);
  }
  return 0;
}

}  // namespace

void append_row(std::string& text, std::span<const double> values) {
  const char* separator = "";
  for (const double value : values) {
    fmt::format_to(std::back_inserter(text), "{}{}", separator, value);
    separator = ",";
  }
  text += '\n';
}

bool has_extent(const std::filesystem::path& file, const Extent& extent) {
  const Descriptor there(::open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat status {};
  if (!there || ::fstat(there.number(), &status) != 0 || !S_ISREG(status.st_mode)) return false;
  if (static_cast<std::uint64_t>(status.st_size) < extent.bytes) return false;
  ContentHash hash;
  return add_bytes(hash, there, extent.bytes) == 0 && hash.text() == extent.hash;
}

Table::Table(std::filesystem::path file, const std::vector<std::string>& columns)
    : file_(std::move(file)) {
  const std::string header = fmt::format("{}\n", fmt::join(columns, ","));
  try {
    write_file(file_.string(), header);
  } catch (const std::runtime_error& error) {
    throw OutsideError(error.what());
  }
  *this = resumed(std::move(file_), header.size());
}

Table Table::resumed(std::filesystem::path file, std::uint64_t bytes) {
  Descriptor descriptor(::open(file.c_str(), O_RDWR | O_APPEND | O_NOFOLLOW | O_CLOEXEC));
  Table table(std::move(file), std::move(descriptor), bytes);
  table.cut(bytes);
  return table;
}

Table::Table(std::filesystem::path file, Descriptor descriptor, std::uint64_t bytes)
    : file_(std::move(file)), descriptor_(std::move(descriptor)) {
  if (!descriptor_) fail(errno);
  read(bytes);
}

void Table::row(std::span<const double> values) {
  buffer_.clear();
  append_row(buffer_, values);
  lines(buffer_);
}

void Table::lines(std::string_view text) {
  if (!descriptor_) return;
  std::size_t written = 0;
  int error = 0;
  while (written < text.size() && error == 0) {
    const ssize_t count =
        ::write(descriptor_.number(), text.data() + written, text.size() - written);
    if (count >= 0)
      written += static_cast<std::size_t>(count);
    else if (errno != EINTR)
      error = errno;
  }
  const auto last = text.substr(0, written).rfind('\n');
  const std::string_view whole = text.substr(0, last == std::string_view::npos ? 0 : last + 1);
  hash_.add(whole);
  bytes_ += whole.size();
  if (error == 0) return;
  if (::ftruncate(descriptor_.number(), static_cast<off_t>(bytes_)) !=
      0) {  // nothing left to save with: the message stays the first error's
  }
  fail(error);
}

void Table::sync() {
  while (::fsync(descriptor_.number()) != 0)
    if (errno != EINTR) fail(errno);
  check();
}

void Table::check() const {
  struct stat written {
  }, named{};
  if (::fstat(descriptor_.number(), &written) != 0) fail(errno);
  if (::lstat(file_.c_str(), &named) != 0 || named.st_dev != written.st_dev ||
      named.st_ino != written.st_ino)
    throw OutsideError(
        fmt::format("{} was removed or replaced while the run wrote it", file_.string()));
  if (static_cast<std::uint64_t>(written.st_size) != bytes_)
    throw OutsideError(
        fmt::format("{} was changed by another program while the run wrote it", file_.string()));
}

void Table::cut(std::uint64_t bytes) {
  if (::ftruncate(descriptor_.number(), static_cast<off_t>(bytes)) != 0) fail(errno);
  if (bytes != bytes_) read(bytes);
}

void Table::read(std::uint64_t bytes) {
  hash_ = ContentHash();
  bytes_ = bytes;
  if (const int error = add_bytes(hash_, descriptor_, bytes); error != 0) fail(error);
}

void Table::fail(int error) const {
  throw OutsideError(
      fmt::format("{}: cannot write: {}", file_.string(), std::system_category().message(error)));
}

}  // namespace hyperlattice
