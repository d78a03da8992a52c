#include <base/errors.hpp>
#include <base/named_file.hpp>

#include <hyperlattice/files.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

namespace hyperlattice {

namespace {

namespace fs = std::filesystem;

/// Writes into an existing file, which is neither created nor replaced.
void write_into(const fs::path& file, std::string_view bytes) {
  const auto fail = [&](const char* what) {
    throw OutsideError(std::string("cannot ") + what + " " + file.string() + ": " +
                       std::generic_category().message(errno));
  };
  const int stream = open(file.c_str(), O_WRONLY | O_TRUNC | O_NOCTTY | O_CLOEXEC);
  if (stream < 0) fail("open");
  while (!bytes.empty()) {
    const ssize_t written = ::write(stream, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      const int reason = errno;
      close(stream);
      errno = reason;
      fail("write");
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  if (close(stream) != 0) fail("write");
}

}  // namespace

void write_named_file(const fs::path& file, std::string_view bytes) {
  std::error_code ignored;
  const fs::file_status named = fs::symlink_status(file, ignored);
  if (fs::exists(named) && named.type() != fs::file_type::regular) return write_into(file, bytes);
  try {
    write_file(file.string(), bytes);
  } catch (const std::runtime_error& error) {
    throw OutsideError(error.what());
  }
}

}  // namespace hyperlattice
