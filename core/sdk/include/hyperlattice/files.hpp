// Files that are either complete or absent, and numbers as text independent of the locale.
#pragma once

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace hyperlattice {

/// A file written under a random temporary name and renamed when it is complete, so that no
/// half-written file ever has its final name. It follows no link and replaces only regular files.
/// Every member throws std::runtime_error with the system's reason; the destructor deletes a file
/// that was not committed.
class AtomicFile {
 public:
  explicit AtomicFile(std::string path) : path_(std::move(path)) {
    struct stat there {};
    if (::lstat(path_.c_str(), &there) == 0 && !S_ISREG(there.st_mode))
      throw std::runtime_error("cannot create " + path_ +
                               ": a folder, link, pipe or device of that name is there");
    for (int tries = 0; file_ == nullptr; ++tries) {
      part_ = path_ + "." + random_digits() + ".part";
      const int descriptor =
          ::open(part_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
      if (descriptor < 0 && errno == EEXIST && tries < 100) continue;
      if (descriptor < 0) fail("create");
      file_ = ::fdopen(descriptor, "wb");
      if (file_ != nullptr) return;
      const int error = errno;
      ::close(descriptor);
      std::remove(part_.c_str());
      errno = error;
      fail("create");
    }
  }
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile() {
    if (committed_) return;
    if (file_ != nullptr) std::fclose(file_);
    std::remove(part_.c_str());
  }

  /// Appends bytes to the file.
  void write(std::string_view bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail("write");
  }

  /// Waits until all bytes are on the disk, so that a power cut after commit() does not lose them.
  void sync() {
    if (std::fflush(file_) != 0 || ::fsync(::fileno(file_)) != 0) fail("write");
  }

  /// Gives the file its final name; replaces an older file of that name atomically.
  void commit() {
    if (std::fclose(std::exchange(file_, nullptr)) != 0)
      fail("write");  // fclose writes the last bytes of the buffer
    if (std::rename(part_.c_str(), path_.c_str()) != 0) fail("rename");
    committed_ = true;
  }

 private:
  static std::string random_digits() {
    constexpr char digits[] = "0123456789abcdef";
    std::random_device source;
    std::string text;
    for (int n = 0; n < 16; ++n) text += digits[source() % 16];
    return text;
  }
  [[noreturn]] void fail(const char* what) const {
    throw std::runtime_error(std::string("cannot ") + what + " " + path_ + ": " +
                             std::generic_category().message(errno));
  }

  std::string path_, part_;
  std::FILE* file_ = nullptr;
  bool committed_ = false;
};

/// Writes a whole file at once, atomically.
inline void write_file(std::string path, std::string_view bytes) {
  AtomicFile file(std::move(path));
  file.write(bytes);
  file.commit();
}

/// Appends the shortest text that reads back as the same number.
inline void append_number(std::string& text, double value) {
  char buffer[32];
  text.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
}

/// Returns a number as text for messages, with at most `digits` significant digits.
inline std::string short_number(double value, int digits = 6) {
  char buffer[48];
  return {
      buffer,
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, digits).ptr};
}

}  // namespace hyperlattice
