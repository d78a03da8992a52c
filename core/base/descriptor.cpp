#include <base/descriptor.hpp>
#include <base/errors.hpp>

#include <spdlog/fmt/fmt.h>

#include <fcntl.h>

#include <cerrno>
#include <system_error>

namespace hyperlattice {

void sync_directory(const std::filesystem::path& directory) {
  const Descriptor folder(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!folder || (::fsync(folder.number()) != 0 && errno != EINVAL && errno != EROFS))
    throw OutsideError(fmt::format("cannot write {}: {}", directory.string(),
                                   std::generic_category().message(errno)));
}

}  // namespace hyperlattice
