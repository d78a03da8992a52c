#include <base/errors.hpp>
#include <base/gnuplot.hpp>

#include <spdlog/fmt/fmt.h>

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace hyperlattice {

namespace {

/// A file that is gone when the object is.
struct Temporary {
  std::filesystem::path path;
  explicit Temporary(std::filesystem::path file) : path(std::move(file)) {}
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  ~Temporary() {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
};

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& why) {
  throw OutsideError(fmt::format("{}: cannot draw it: {}", file.string(), why));
}

std::string reason(int error) { return std::system_category().message(error); }

std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("''") : std::string(1, c);
  return out + "'";
}

/// Puts the commands into a new file, for gnuplot to read, and gives its name.
std::string write_script(const std::filesystem::path& file, const std::string& commands) {
  std::string name = (std::filesystem::temp_directory_path() / "hyperlattice_XXXXXX").string();
  const int descriptor = ::mkstemp(name.data());
  if (descriptor < 0) fail(file, reason(errno));
  for (std::size_t written = 0; written < commands.size();) {
    const ssize_t count = ::write(descriptor, commands.data() + written, commands.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      const int error = errno;
      ::close(descriptor);
      ::unlink(name.c_str());
      fail(file, reason(error));
    }
    written += static_cast<std::size_t>(count);
  }
  ::close(descriptor);
  return name;
}

}  // namespace

void draw_svg(const std::filesystem::path& file, const std::string& commands, int width, int height) {
  const Temporary part(file.string() + ".part");
  const Temporary script(write_script(file, fmt::format("set terminal svg size {},{} font 'Helvetica,13' background 'white'\nset output {}\n{}\n",
                                                        width, height, quoted(part.path.string()), commands)));
  std::string program = "gnuplot", argument = script.path.string();
  char* words[] = {program.data(), argument.data(), nullptr};
  pid_t child = 0;
  const int error = ::posix_spawnp(&child, program.c_str(), nullptr, nullptr, words, environ);
  if (error == ENOENT) fail(file, "gnuplot is not installed (Debian's package gnuplot-nox)");
  if (error != 0) fail(file, "gnuplot: " + reason(error));
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) fail(file, "gnuplot failed");
  std::error_code renamed;
  std::filesystem::rename(part.path, file, renamed);
  if (renamed) fail(file, renamed.message());
}

}  // namespace hyperlattice
