#include <base/descriptor.hpp>
#include <base/errors.hpp>
#include <base/input_file.hpp>

#include <spdlog/fmt/fmt.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

namespace hyperlattice {

namespace {

constexpr const char* too_large = "it is larger than 4 GB, the most that is read";
static_assert(largest_input >> 30 == 4);

std::string fault_of(const struct stat& file) {
  if (S_ISDIR(file.st_mode)) return "it is a folder";
  if (!S_ISREG(file.st_mode)) return "it is a device or a pipe, and only regular files are read";
  return static_cast<std::uint64_t>(file.st_size) > largest_input ? too_large : "";
}

std::string fault_of_error(int error) {
  return error == ENOENT || error == ENOTDIR || error == ELOOP || error == ENAMETOOLONG
             ? "there is no such file"
             : "";
}

}  // namespace

std::string input_file_fault(const std::filesystem::path& file) {
  struct stat status {};
  return ::stat(file.c_str(), &status) == 0 ? fault_of(status) : fault_of_error(errno);
}

std::string read_input_file(const std::filesystem::path& file, const std::string& pointer,
                            const std::string& what) {
  const auto refuse = [&](const std::string& why) {
    return why.empty() ? void()
                       : throw InputError(
                             {{pointer, fmt::format("\"{}\"", file.string()), what + "; " + why}});
  };
  const auto fail = [&](int error) {
    return OutsideError(fmt::format("{} cannot be read: {}", file.string(),
                                    std::generic_category().message(error)));
  };
  refuse(input_file_fault(file));  // before opening, since opening a device can have effects
  const Descriptor descriptor(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY));
  if (!descriptor) throw fail(errno);
  struct stat status {};
  if (::fstat(descriptor.number(), &status) != 0) throw fail(errno);
  refuse(fault_of(status));
  std::string text;
  std::size_t filled = 0;
  // one byte more, so that the end shows without another block
  text.resize(static_cast<std::size_t>(status.st_size) + 1);
  for (;;) {
    const ssize_t count = ::read(descriptor.number(), text.data() + filled, text.size() - filled);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw fail(errno);
    if (count == 0) break;
    filled += static_cast<std::size_t>(count);
    if (filled > largest_input) refuse(too_large);
    // the file grows, or its size is unknown, as in /proc
    if (filled == text.size()) text.resize(std::max<std::size_t>(2 * filled, 4096));
  }
  text.resize(filled);
  return text;
}

}  // namespace hyperlattice
