// A file descriptor with an owner, and the writing of a folder's entries to the disk.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <utility>

namespace hyperlattice {

/// Owns a file descriptor and closes it at the end; -1: no file.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }

  int number() const { return number_; }
  explicit operator bool() const { return number_ >= 0; }

 private:
  int number_;
};

/// Waits until a folder's entries (new, renamed and removed files) are on the disk. Throws
/// OutsideError if the system refuses; does nothing on file systems without this function.
void sync_directory(const std::filesystem::path& directory);

}  // namespace hyperlattice
