// Files that are whole or not there, and numbers as text that no locale changes.
#pragma once

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace hyperlattice {

/// A file written as `<path>.part` and renamed when it is complete, so that no half-written file ever stands under its final name.
/// Every member throws std::runtime_error with the system's reason; an uncommitted file vanishes with the object.
class AtomicFile {
 public:
  explicit AtomicFile(std::string path) : path_(std::move(path)), part_(path_ + ".part"), file_(std::fopen(part_.c_str(), "wb")) {
    if (file_ == nullptr) fail("create");
  }
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile() {
    if (committed_) return;
    if (file_ != nullptr) std::fclose(file_);
    std::remove(part_.c_str());
  }

  void write(std::string_view bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail("write");
  }

  /// Gives the file its name; an older file of that name is replaced in one go.
  void commit() {
    if (std::fclose(std::exchange(file_, nullptr)) != 0) fail("write");  // the last bytes leave the buffer here
    if (std::rename(part_.c_str(), path_.c_str()) != 0) fail("rename");
    committed_ = true;
  }

 private:
  [[noreturn]] void fail(const char* what) const {
    throw std::runtime_error(std::string("cannot ") + what + " " + path_ + ": " + std::generic_category().message(errno));
  }

  std::string path_, part_;
  std::FILE* file_;
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

/// A number for people: at most `digits` significant digits.
inline std::string short_number(double value, int digits = 6) {
  char buffer[48];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, digits).ptr};
}

}  // namespace hyperlattice
