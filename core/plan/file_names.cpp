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

/// A writer without a folder, and the text that all its files' names begin with.
struct Unlabelled {
  const Stage* writer;
  std::string base;
};

std::vector<Unlabelled> unlabelled_of(const std::vector<const Stage*>& writers, const nlohmann::json& resolved) {
  std::vector<Unlabelled> unlabelled;
  for (const Stage* writer : writers) {
    if (has_folder(*writer)) continue;
    const nlohmann::json::json_pointer place(writer->pointer + "/file");
    if (resolved.contains(place) && resolved[place].is_string()) unlabelled.push_back({writer, resolved[place].get<std::string>()});
  }
  return unlabelled;
}

}  // namespace

void check_file_names(const Scene& scene, Faults& faults) {
  const auto resolved = nlohmann::json::parse(scene.resolved, nullptr, false);
  const auto writers = scene.of(Family::writers);
  const std::vector<Unlabelled> unlabelled = unlabelled_of(writers, resolved);
  for (const Stage* writer : writers) {
    if (!has_folder(*writer)) continue;
    const std::string& name = writer->name;
    if (std::find(std::begin(run_file_names), std::end(run_file_names), name) != std::end(run_file_names))
      faults.add(writer->pointer + "/name", name, fmt::format("a label that is no file of the run; those are {}", fmt::join(run_file_names, ", ")));
    for (const auto& [other, base] : unlabelled) {
      if (name.starts_with(base) && name.find('.', base.size()) != std::string::npos)
        faults.add(writer->pointer + "/name", name,
                   fmt::format("a label that is no file of {} ({}), which are called {}...", other->pointer, other->component->type(), base));
    }
  }
}

}  // namespace hyperlattice
