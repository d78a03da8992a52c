// What tests share that cut runs off: all files of a run.
#pragma once

#include <base/own_files.hpp>
#include <support/state_scenes.hpp>

#include <map>
#include <string>

namespace hyperlattice::test {

/// All files of a run, without its times.
inline std::map<std::string, std::string> left_behind(const std::string& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      files[std::filesystem::relative(entry.path(), folder).string()] =
          contents(entry.path().string());
  nlohmann::json summary = nlohmann::json::parse(files.at("summary.json"));
  for (const char* key : {"wall_seconds", "nanoseconds_per_particle_step", "peak_memory_bytes"})
    summary.erase(key);
  files["summary.json"] = summary.dump(1);
  std::string& list = files["files.csv"];  // only the last entry of each file counts
  const OwnFiles own = parse_own_files(list);
  list.clear();
  for (const auto& [name, file] : own)
    if (name != "summary.json") list += own_file_line(name, file);
  return files;
}

}  // namespace hyperlattice::test
