#include <base/errors.hpp>
#include <base/own_files.hpp>

#include <spdlog/fmt/fmt.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <system_error>

namespace hyperlattice {

std::optional<OwnFiles> read_own_files(const std::filesystem::path& directory) {
  const std::filesystem::path path = directory / own_files_list;
  const auto fail = [&] {
    return OutsideError(fmt::format("{} cannot be read: {}", path.string(),
                                    std::generic_category().message(errno)));
  };
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0 && (errno == ENOENT || errno == ENOTDIR)) return std::nullopt;
  if (descriptor < 0) throw fail();
  std::string text;
  std::array<char, 1 << 16> bytes{};
  ssize_t count = 0;
  while ((count = ::read(descriptor, bytes.data(), bytes.size())) > 0 ||
         (count < 0 && errno == EINTR))
    if (count > 0) text.append(bytes.data(), static_cast<std::size_t>(count));
  const int error = errno;
  ::close(descriptor);
  errno = error;
  if (count < 0) throw fail();
  return parse_own_files(text);
}

OwnFiles parse_own_files(std::string_view text) {
  OwnFiles files;
  for (std::size_t begin = 0, end = 0; (end = text.find('\n', begin)) != std::string_view::npos;
       begin = end + 1) {
    const std::string_view line = text.substr(begin, end - begin);
    const auto first = line.find(','),
               second = first == std::string_view::npos ? first : line.find(',', first + 1);
    if (second == std::string_view::npos) continue;
    const std::string_view size = line.substr(0, first), name = line.substr(second + 1);
    OwnFile file;
    file.hash = line.substr(first + 1, second - first - 1);
    const auto [last, error] = std::from_chars(size.data(), size.data() + size.size(), file.bytes);
    if (!size.empty() && (error != std::errc() || last != size.data() + size.size())) continue;
    if (size.empty() != file.hash.empty() || !is_own_name(name)) continue;
    files.insert_or_assign(std::string(name), std::move(file));
  }
  return files;
}

std::string own_file_line(std::string_view name, const OwnFile& file) {
  return file.hash.empty() ? fmt::format(",,{}\n", name)
                           : fmt::format("{},{},{}\n", file.bytes, file.hash, name);
}

bool is_own_name(std::string_view name) {
  const std::filesystem::path path(name);
  if (path.empty() || path.is_absolute() || !path.has_filename() || name == own_files_list)
    return false;
  if (std::any_of(name.begin(), name.end(),
                  [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }))
    return false;
  return std::all_of(path.begin(), path.end(),
                     [](const auto& part) { return part != "." && part != ".." && !part.empty(); });
}

}  // namespace hyperlattice
