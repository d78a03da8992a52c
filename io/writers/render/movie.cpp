#include "movie.hpp"

#include <hyperlattice/files.hpp>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

namespace hyperlattice::render {

namespace {

std::optional<std::string> find_program(std::string_view name) {
  const char* const path = std::getenv("PATH");
  std::string_view folders = path == nullptr ? "" : path;
  while (!folders.empty()) {
    const std::size_t end = std::min(folders.find(':'), folders.size());
    const std::string file = std::string(folders.substr(0, end)) + "/" + std::string(name);
    if (end > 0 && ::access(file.c_str(), X_OK) == 0 && !std::filesystem::is_directory(file))
      return std::filesystem::absolute(file).string();
    folders.remove_prefix(std::min(end + 1, folders.size()));
  }
  return std::nullopt;
}

/// Runs a program in a folder, without a shell, with its messages in a file. Returns its exit
/// status, or -1 if a signal ended it.
int run(const std::vector<std::string>& arguments, const std::string& folder,
        const std::string& messages) {
  std::vector<char*> list;
  list.reserve(arguments.size() + 1);
  for (const std::string& argument : arguments) list.push_back(const_cast<char*>(argument.c_str()));
  list.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, messages.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  // The programs give a meaning to '%', ':' and a first '-', which the folder's path may have.
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  pid_t process = 0;
  const int error = ::posix_spawn(&process, list[0], &actions, nullptr, list.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0)
    throw std::runtime_error("cannot start " + arguments[0] + ": " +
                             std::generic_category().message(error));
  int status = 0;
  while (::waitpid(process, &status, 0) < 0)
    if (errno != EINTR)
      throw std::runtime_error("cannot wait for " + arguments[0] + ": " +
                               std::generic_category().message(errno));
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// Returns the last line in the first 4096 bytes of a file.
std::string last_line(const std::string& file) {
  std::string text(4096, '\0');
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return "";
  const ssize_t size = ::read(descriptor, text.data(), text.size());
  ::close(descriptor);
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(0, size)));
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

std::vector<std::string> ffmpeg_arguments(const MovieMaker& maker, MovieKind kind,
                                          const MovieFrames& frames) {
  // "-frames:v": pictures of later numbers may be those of an earlier run that was interrupted.
  std::vector<std::string> list{maker.program,
                                "-nostdin",
                                "-y",
                                "-loglevel",
                                "error",
                                "-framerate",
                                short_number(frames.rate),
                                "-start_number",
                                "0",
                                "-i",
                                "./" + frames.pattern,
                                "-frames:v",
                                std::to_string(frames.names.size())};
  const auto add = [&](std::initializer_list<const char*> more) {
    list.insert(list.end(), more.begin(), more.end());
  };
  if (kind == MovieKind::mp4)  // players want an even number of pixels and this pixel format
    add({"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white", "-pix_fmt", "yuv420p", "-f", "mp4"});
  else if (kind == MovieKind::gif)
    add({"-vf", "split[a][b];[a]palettegen[p];[b][p]paletteuse", "-loop", "0", "-f", "gif"});
  else
    add({"-loop", "0", "-quality", "90", "-f", "webp"});
  return list;
}

std::vector<std::string> magick_arguments(const MovieMaker& maker, const MovieFrames& frames) {
  // Hundredths of a second.
  std::vector<std::string> list{maker.program, "-delay", short_number(100 / frames.rate), "-loop",
                                "0"};
  for (const std::string& name : frames.names) list.push_back("./" + name);
  return list;
}

}  // namespace

std::optional<MovieMaker> find_movie_maker(MovieKind kind) {
  if (auto program = find_program("ffmpeg")) return MovieMaker{*program, true};
  if (kind == MovieKind::mp4) return std::nullopt;
  for (const char* name : {"magick", "convert"})
    if (auto program = find_program(name)) return MovieMaker{*program, false};
  return std::nullopt;
}

void make_movie(const MovieMaker& maker, MovieKind kind, const MovieFrames& frames,
                const std::string& file) {
  const std::string part = file + ".part", messages = file + ".messages.part",
                    output = "./" + std::filesystem::path(part).filename().string();
  auto arguments =
      maker.is_ffmpeg ? ffmpeg_arguments(maker, kind, frames) : magick_arguments(maker, frames);
  const std::string_view name = movie_names[static_cast<std::size_t>(kind)];
  arguments.push_back(maker.is_ffmpeg ? output : std::string(name) + ":" + output);
  const int status = run(arguments, frames.folder, messages);
  const std::string answer = last_line(messages);
  std::remove(messages.c_str());
  if (status != 0 || ::access(part.c_str(), F_OK) != 0) {
    std::remove(part.c_str());
    throw std::runtime_error(maker.program + " makes no film; the frames are there" +
                             (answer.empty() ? "" : ": " + answer));
  }
  if (std::rename(part.c_str(), file.c_str()) != 0) {
    const int error = errno;
    std::remove(part.c_str());
    throw std::runtime_error("cannot rename " + part + ": " +
                             std::generic_category().message(error));
  }
}

}  // namespace hyperlattice::render
