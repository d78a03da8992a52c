#include <plan/file_names.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace hyperlattice {

namespace {

/// A writer that has no label of its own puts its files into the run's folder; another has a folder called like its label.
bool has_folder(const Stage& writer) {
  const std::string type = writer.component->type();
  return writer.name != type.substr(type.find('.') + 1);
}

}  // namespace

void check_file_names(const Scene& scene, Faults& faults) {
  const auto resolved = nlohmann::json::parse(scene.resolved, nullptr, false);
  const auto writers = scene.of(Family::writers);
  for (const Stage* writer : writers) {
    if (!has_folder(*writer)) continue;
    const std::string& name = writer->name;
    if (std::find(std::begin(run_file_names), std::end(run_file_names), name) != std::end(run_file_names))
      faults.add(writer->pointer + "/name", name, fmt::format("a label that is no file of the run; those are {}", fmt::join(run_file_names, ", ")));
    for (const Stage* other : writers) {
      const nlohmann::json::json_pointer place(other->pointer + "/file");
      if (has_folder(*other) || !resolved.contains(place) || !resolved[place].is_string()) continue;
      const std::string base = resolved[place].get<std::string>();
      if (name.starts_with(base) && name.find('.', base.size()) != std::string::npos)
        faults.add(writer->pointer + "/name", name,
                   fmt::format("a label that is no file of {} ({}), which are called {}...", other->pointer, other->component->type(), base));
    }
  }
}

}  // namespace hyperlattice
