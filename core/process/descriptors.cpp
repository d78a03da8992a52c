#include <process/descriptors.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

namespace hyperlattice {

void open_missing_streams() noexcept {
  for (int stream = 0; stream <= 2; ++stream) {
    if (fcntl(stream, F_GETFD) != -1 || errno != EBADF) continue;
    const int opened = open(
        "/dev/null", stream == 2 ? O_WRONLY : O_RDONLY);  // takes the lowest number that is free
    if (opened > 2) close(opened);
  }
}

}  // namespace hyperlattice
