#include <base/descriptor.hpp>
#include <base/errors.hpp>
#include <base/folder_file.hpp>

#include <spdlog/fmt/fmt.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

namespace hyperlattice {

namespace {

bool leads_out(const std::filesystem::path& name) {
  if (name.empty() || name.is_absolute()) return true;
  for (const auto& part : name)
    if (part == ".." || part == ".") return true;
  return false;
}

/// Opens the parts of the name one by one, so that none of them may be a link. Returns 0 or the
/// system's error. Opens a pipe without waiting for a writer.
int open_within(Descriptor& file, const std::filesystem::path& folder,
                const std::filesystem::path& name) {
  constexpr int flags = O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY;
  file = Descriptor(::open(folder.c_str(), flags | O_DIRECTORY));
  for (const auto& part : name) {
    if (file.number() < 0) return errno;
    file = Descriptor(::openat(file.number(), part.c_str(), flags | O_NOFOLLOW));
  }
  return file.number() < 0 ? errno : 0;
}

/// Reads until the text is full or the file ends. Returns 0 or the system's error.
int fill(const Descriptor& file, std::string& text) {
  std::size_t filled = 0;
  while (filled < text.size()) {
    const ssize_t count = ::read(file.number(), text.data() + filled, text.size() - filled);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    if (count == 0) break;
    filled += static_cast<std::size_t>(count);
  }
  text.resize(filled);
  return 0;
}

}  // namespace

std::optional<FolderFile> read_folder_file(const std::filesystem::path& folder,
                                           const std::filesystem::path& name, std::uint64_t most,
                                           bool head) {
  const auto fail = [&](int error) {
    return OutsideError(fmt::format("{} cannot be read: {}", (folder / name).string(),
                                    std::generic_category().message(error)));
  };
  FolderFile found;
  if (leads_out(name)) {
    found.refusal = "a name that leads out of the folder";
    return found;
  }
  Descriptor file;
  const int error = open_within(file, folder, name);
  if (error == ENOENT || error == ENOTDIR || error == ENAMETOOLONG) return std::nullopt;
  if (error == ELOOP) found.refusal = "a link";
  if (error == ENXIO) found.refusal = "a device or socket";
  if (!found.refusal.empty()) return found;
  if (error != 0) throw fail(error);
  struct stat status {};
  if (::fstat(file.number(), &status) != 0) throw fail(errno);
  if (!S_ISREG(status.st_mode)) {
    found.refusal = "a folder, device or pipe";
    return found;
  }
  const auto size = static_cast<std::uint64_t>(status.st_size);
  if (size > most && !head) {
    found.refusal = fmt::format("larger than {} MB", most >> 20);
    return found;
  }
  found.text.resize(std::min(size, most));
  if (const int failed = fill(file, found.text); failed != 0) throw fail(failed);
  return found;
}

bool is_there(const std::filesystem::path& path) {
  struct stat status {};
  return ::lstat(path.c_str(), &status) == 0;
}

bool has_folder_file(const std::filesystem::path& folder, const std::filesystem::path& name) {
  if (leads_out(name)) return false;
  Descriptor file;
  struct stat status {};
  return open_within(file, folder, name) == 0 && ::fstat(file.number(), &status) == 0 &&
         S_ISREG(status.st_mode);
}

}  // namespace hyperlattice
