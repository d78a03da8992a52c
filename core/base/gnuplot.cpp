#include <base/errors.hpp>
#include <base/gnuplot.hpp>

#include <hyperlattice/files.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <iterator>
#include <system_error>
#include <thread>
#include <vector>

namespace hyperlattice {

namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& why) {
  throw OutsideError(fmt::format("{}: cannot draw it: {}", file.string(), why));
}

std::string reason(int error) { return std::system_category().message(error); }

/// A file in memory; it has no name, so no other program can open it.
class MemoryFile {
 public:
  explicit MemoryFile(const std::filesystem::path& picture)
      : picture_(picture), descriptor_(::memfd_create("hyperlattice", MFD_CLOEXEC)) {
    if (descriptor_ < 0) fail(picture_, reason(errno));
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { ::close(descriptor_); }

  int descriptor() const { return descriptor_; }

  void write(const std::string& text) {
    for (std::size_t written = 0; written < text.size();) {
      const ssize_t count = ::pwrite(descriptor_, text.data() + written, text.size() - written,
                                     static_cast<off_t>(written));
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) fail(picture_, reason(errno));
      written += static_cast<std::size_t>(count);
    }
  }
  std::string read() const {
    std::string text;
    std::array<char, 1 << 16> bytes{};
    for (;;) {
      const ssize_t count =
          ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(text.size()));
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) fail(picture_, reason(errno));
      if (count == 0) return text;
      text.append(bytes.data(), static_cast<std::size_t>(count));
    }
  }

 private:
  const std::filesystem::path& picture_;
  int descriptor_;
};

/// Returns the environment without variables that change gnuplot's pictures.
std::vector<char*> environment() {
  std::vector<char*> kept;
  for (char** entry = environ; entry != nullptr && *entry != nullptr; ++entry) {
    const std::string_view text = *entry;
    if (!text.starts_with("GNUPLOT") && !text.starts_with("GNUTERM") &&
        !text.starts_with("GNUHELP"))
      kept.push_back(*entry);
  }
  kept.push_back(nullptr);
  return kept;
}

/// Waits until the child ends and returns true. After `patience` kills the child and returns false.
bool wait_for(pid_t child, int& status, std::chrono::milliseconds patience) {
  const auto until = std::chrono::steady_clock::now() + patience;
  for (;;) {
    const pid_t ended = ::waitpid(child, &status, WNOHANG);
    if (ended == child || (ended < 0 && errno != EINTR)) return true;
    if (std::chrono::steady_clock::now() >= until) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  ::kill(child, SIGKILL);
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return false;
}

/// Returns the last line of gnuplot's messages, which gives the error.
std::string last_line(const std::string& text) {
  const auto end = text.find_last_not_of(" \n\r\t");
  if (end == std::string::npos) return "";
  const auto begin = text.rfind('\n', end);
  return text.substr(begin == std::string::npos ? 0 : begin + 1,
                     end - (begin == std::string::npos ? std::size_t(-1) : begin));
}

}  // namespace

std::string gnuplot_text(std::string_view text) {
  // Double quotes, because gnuplot 5.4 loses a plot whose single-quoted texts contain or begin with
  // single quotes. Within double quotes gnuplot runs commands in backquotes and interprets
  // backslashes. So all such characters become octal numbers, with three digits, so that a
  // following digit cannot be read as part of them.
  const std::string quoted =
      nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  std::string out = "\"";
  for (const char c : nlohmann::json::parse(quoted).get<std::string>()) {
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    if (c == '"')
      out += "\\\"";
    else if (c == '\n')
      out += "\\n";
    else if (c >= 0x40 && c < 0x7f && !is_letter)  // @ [ \ ] ^ _ ` { | } ~
      fmt::format_to(std::back_inserter(out), "\\{:03o}", static_cast<unsigned>(c));
    else
      out += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
  }
  return out + '"';
}

std::string svg_picture(const std::filesystem::path& file, const std::string& commands, int width,
                        int height, std::chrono::milliseconds patience) {
  MemoryFile script(file), picture(file), words(file);
  script.write(
      fmt::format("set terminal svg size {},{} font 'Helvetica,13' background 'white'\nset "
                  "encoding utf8\nset tics out\n{}\n",
                  width, height, commands));
  std::string program = "gnuplot", plain = "--default-settings";
  char* arguments[] = {program.data(), plain.data(), nullptr};
  posix_spawn_file_actions_t streams;
  posix_spawn_file_actions_init(&streams);
  posix_spawn_file_actions_adddup2(&streams, script.descriptor(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&streams, picture.descriptor(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&streams, words.descriptor(), STDERR_FILENO);
  pid_t child = 0;
  const int error =
      ::posix_spawnp(&child, program.c_str(), &streams, nullptr, arguments, environment().data());
  posix_spawn_file_actions_destroy(&streams);
  if (error == ENOENT) fail(file, "gnuplot is not installed (Debian's package gnuplot-nox)");
  if (error != 0) fail(file, "gnuplot: " + reason(error));
  int status = 0;
  if (!wait_for(child, status, patience))
    fail(file, fmt::format("gnuplot took longer than {:g} s, and was ended",
                           1e-3 * static_cast<double>(patience.count())));
  std::string drawn = picture.read();
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || drawn.find("</svg>") == std::string::npos)
    fail(file, "gnuplot failed: " + last_line(words.read()));
  return drawn;
}

void draw_svg(const std::filesystem::path& file, const std::string& commands, int width, int height,
              std::chrono::milliseconds patience) {
  const std::string drawn = svg_picture(file, commands, width, height, patience);
  try {
    write_file(file.string(), drawn);
  } catch (const std::runtime_error& unwritten) {
    fail(file, unwritten.what());
  }
}

}  // namespace hyperlattice
