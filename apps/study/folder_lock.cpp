#include <base/errors.hpp>
#include <study/folder_lock.hpp>

#include <spdlog/spdlog.h>

#include <fcntl.h>
#include <sys/file.h>

#include <cerrno>
#include <system_error>

namespace hyperlattice::study {

FolderLock::FolderLock(const std::filesystem::path& folder)
    : folder_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  const auto reason = [] { return std::generic_category().message(errno); };
  if (!folder_) throw OutsideError(fmt::format("cannot open {}: {}", folder.string(), reason()));
  if (::flock(folder_.number(), LOCK_EX | LOCK_NB) == 0) return;
  if (errno == EWOULDBLOCK)
    throw OutsideError(
        fmt::format("{} is in use: another study is running there; wait until it ends, or choose "
                    "another folder",
                    folder.string()));
  spdlog::warn("warning: {} cannot be locked ({}): let no other study run there", folder.string(),
               reason());
}

}  // namespace hyperlattice::study
