// Tables: appended through the system's own calls, because they alone say how much of a line reached the disk.
#include <base/errors.hpp>
#include <run/archive.hpp>
#include <run/table.hpp>

#include <spdlog/fmt/fmt.h>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <iterator>
#include <system_error>
#include <utility>

namespace hyperlattice {

void append_row(std::string& text, std::span<const double> values) {
  const char* separator = "";
  for (const double value : values) {
    fmt::format_to(std::back_inserter(text), "{}{}", separator, value);
    separator = ",";
  }
  text += '\n';
}

Table::Table(std::filesystem::path file, const std::vector<std::string>& columns) : file_(std::move(file)) {
  descriptor_ = ::open(file_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail(errno);
  lines(fmt::format("{}\n", fmt::join(columns, ",")));
}

void Table::save(Archive& archive) {
  std::uint64_t now = bytes();
  archive(now);
}

Table Table::resumed(std::filesystem::path file, Archive& archive) {
  std::uint64_t saved = 0;
  archive(saved);
  Table table(std::move(file));
  table.descriptor_ = ::open(table.file_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (table.descriptor_ < 0) table.fail(errno);
  if (table.bytes() < saved) throw OutsideError(fmt::format("{}: shorter than when the checkpoint was made", table.file_.string()));
  if (::ftruncate(table.descriptor_, static_cast<off_t>(saved)) != 0) table.fail(errno);
  return table;
}

std::uint64_t Table::bytes() const { return static_cast<std::uint64_t>(::lseek(descriptor_, 0, SEEK_END)); }

Table::Table(Table&& other) noexcept
    : file_(std::move(other.file_)), descriptor_(std::exchange(other.descriptor_, -1)), buffer_(std::move(other.buffer_)) {}

Table::~Table() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void Table::row(std::span<const double> values) {
  buffer_.clear();
  append_row(buffer_, values);
  lines(buffer_);
}

void Table::lines(std::string_view text) {
  const off_t before = ::lseek(descriptor_, 0, SEEK_END);
  std::size_t written = 0;
  while (written < text.size()) {
    const ssize_t count = ::write(descriptor_, text.data() + written, text.size() - written);
    if (count >= 0) {
      written += static_cast<std::size_t>(count);
    } else if (errno != EINTR) {
      const int error = errno;
      const auto last = text.substr(0, written).rfind('\n');
      const std::size_t whole = last == std::string_view::npos ? 0 : last + 1;
      if (::ftruncate(descriptor_, before + static_cast<off_t>(whole)) != 0) {  // nothing left to save with: the message stays the first error's
      }
      fail(error);
    }
  }
}

void Table::fail(int error) { throw OutsideError(fmt::format("{}: cannot write: {}", file_.string(), std::system_category().message(error))); }

}  // namespace hyperlattice
