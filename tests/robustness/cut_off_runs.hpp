// What tests share that cut runs off: the scene, and all files of a run.
#pragma once

#include <base/own_files.hpp>
#include <support/program.hpp>

#include <map>
#include <string>

namespace hyperlattice::test {

/// A block that is pulled apart, with all kinds of outputs.
inline nlohmann::json pulled_block() {
  return nlohmann::json::parse(R"({ "format": "hyperlattice/1", "pipeline": [
    { "type": "lattices.cubic", "spacing": 1e-3, "shape": { "box": { "low": [0, 0, 0], "high": [0.012, 0.012, 0.02] } } },
    { "type": "materials.elastic", "young": "10 GPa", "poisson": 0.1, "density": 2500, "membrane": "I-m",
      "failure": { "type": "failures.elongation", "limit": "2e-3 mm" } },
    { "type": "loads.fixed", "on": "z_min" }, { "type": "loads.velocity", "on": "z_max", "value": [0, 0, 1], "rise": "10 us" },
    { "type": "loads.drag", "density": 1000 },
    { "type": "solvers.explicit", "end_time": "1 ms" },
    { "type": "writers.vtu", "every": "100 us" }, { "type": "writers.csv", "every": "300 us", "name": "tables" },
    { "type": "writers.picture", "every": "400 us", "width": 320, "height": 320 },
    { "type": "probes.point", "name": "top", "position": [0.006, 0.006, 0.02] }, { "type": "probes.line", "name": "axis", "start": [0.006, 0.006, 0],
      "end": [0.006, 0.006, 0.02], "points": 5, "every": "200 us" } ] })");
}

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
