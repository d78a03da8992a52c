// Runs the real program in a test and returns its exit code and its output; also a small scene to
// run.
#pragma once

#include "output.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <functional>
#include <thread>

namespace hyperlattice::test {

struct Result {
  int exit_code = -1;  ///< 1000 + signal if a signal ended the program
  std::string out, err;
};

struct Launch {
  std::uint64_t file_limit = 0;          ///< largest size of a file, bytes; 0: no limit
  std::uint64_t memory_limit = 0;        ///< address space, bytes; 0: no limit
  std::function<void(pid_t)> meanwhile;  ///< is called while the program runs
  std::vector<std::string> environment;  ///< "NAME=value"
  std::string directory;                 ///< working directory; empty: the present one
};

/// Runs `hyperlattice` of this build with the arguments.
inline Result run_program(const std::vector<std::string>& arguments, const Launch& launch = {}) {
  const Folder folder("program");
  const std::string program = std::string(HYPERLATTICE_BUILD) + "/bin/hyperlattice",
                    out = folder.file("out"), err = folder.file("err");
  std::vector<char*> words{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments)
    words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    for (const auto& [file, stream] : {std::pair{&out, 1}, std::pair{&err, 2}})
      dup2(open(file->c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), stream);
    setenv("OMP_WAIT_POLICY", "passive",
           1);  // tests share the processor, so that waiting threads must not spin
    for (const std::string& setting : launch.environment)
      putenv(const_cast<char*>(setting.c_str()));
    if (launch.file_limit > 0) {
      const struct rlimit limit = {launch.file_limit, launch.file_limit};
      setrlimit(RLIMIT_FSIZE, &limit);
    }
    if (launch.memory_limit > 0) {
      const struct rlimit limit = {launch.memory_limit, launch.memory_limit};
      setrlimit(RLIMIT_AS, &limit);
    }
    if (!launch.directory.empty() && chdir(launch.directory.c_str()) != 0) _exit(127);
    execv(program.c_str(), words.data());
    _exit(127);
  }
  if (launch.meanwhile) launch.meanwhile(child);
  int status = 0;
  waitpid(child, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status), contents(out),
          contents(err)};
}

/// Waits until a condition holds, at most one minute.
inline bool wait_until(const std::function<bool()>& condition) {
  for (int n = 0; n < 6000; ++n) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

/// A hollow sphere under a blast, radius 8 mm, cavity 4 mm, 1,888 particles.
inline nlohmann::json small_sphere() {
  return nlohmann::json::parse(R"({
    "format": "hyperlattice/1", "title": "small sphere",
    "pipeline": [
      { "type": "lattices.cubic", "spacing": "1 mm", "shape": { "hollow_sphere": { "inner_radius": "4 mm", "outer_radius": "8 mm" } } },
      { "type": "materials.elastic", "young": "10 GPa", "poisson": 0.1, "density": 2500, "membrane": "I-m" },
      { "type": "loads.blast", "on": "inner_surface", "peak": "100 MPa", "rise": "2 us", "fall": "5 us" },
      { "type": "solvers.explicit", "end_time": "10 us" } ] })");
}

inline std::string write_scene(const Folder& folder, const nlohmann::json& scene) {
  const std::string file = folder.file("scene.json");
  std::ofstream(file) << scene.dump(1);
  return file;
}

inline nlohmann::json read_json(const std::string& file) {
  return nlohmann::json::parse(contents(file));
}

/// The rows of a table below its header, as text.
inline std::vector<std::string> table_rows(const std::string& file) {
  std::istringstream lines(contents(file));
  std::vector<std::string> rows;
  for (std::string line; std::getline(lines, line);) rows.push_back(line);
  if (!rows.empty()) rows.erase(rows.begin());
  return rows;
}

}  // namespace hyperlattice::test
