#include <process/descriptors.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

namespace hyperlattice {

void open_missing_streams() noexcept {
  for (int stream = 0; stream <= 2; ++stream) {
    if (fcntl(stream, F_GETFD) != -1 || errno != EBADF) continue;
    // open() takes the lowest free number
    const int opened = open("/dev/null", stream == 2 ? O_WRONLY : O_RDONLY);
    if (opened > 2) close(opened);
  }
}

}  // namespace hyperlattice
