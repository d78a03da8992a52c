// An open file that closes itself, and folders whose entries reach the disk.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <utility>

namespace hyperlattice {

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

/// Waits until a folder's entries are on the disk: new names, renamed and removed files.
/// OutsideError if the system refuses; file systems that know no such thing pass.
void sync_directory(const std::filesystem::path& directory);

}  // namespace hyperlattice
