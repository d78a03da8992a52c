// What the targets share. A target reads one input. It may refuse the input by an exception of the
// stated type; libFuzzer reports every other exception, crash, leak, hang and excess of memory.
#pragma once

#include <spdlog/spdlog.h>

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace fuzz {

/// Fails the target.
inline void require(bool holds) {
  if (!holds) std::abort();
}

/// Reads an input, which may be refused by a `Refusal` that says why.
template <class Refusal, class Read>
void read_or_refuse(const Read& read) {
  try {
    read();
  } catch (const Refusal& refusal) {
    require(*refusal.what() != '\0');
  }
}

/// A folder for files (tests/fuzz/run puts it into memory), removed at the end of the process.
/// Warnings of the product are not shown.
class Folder {
 public:
  Folder()
      : path_((std::filesystem::temp_directory_path() / "hyperlattice_fuzz_").string() +
              std::to_string(::getpid())) {
    spdlog::set_level(spdlog::level::off);
    std::filesystem::create_directory(path_);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  std::string file(std::string_view name) const { return path_ + "/" + std::string(name); }
  /// Writes a file. Returns its path.
  std::string write(std::string_view name, std::string_view bytes) const {
    std::ofstream(file(name), std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return file(name);
  }

 private:
  std::string path_;
};

/// The bytes of an input as text.
inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Cuts a text at the first form feed, which separates two files in one input. `rest`: what
/// follows.
inline std::string_view first_file(std::string_view text, std::string_view& rest) {
  const std::size_t end = std::min(text.find('\f'), text.size());
  rest = text.substr(std::min(end + 1, text.size()));
  return text.substr(0, end);
}

}  // namespace fuzz
