#include <plan/estimates.hpp>
#include <plan/file_names.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>

namespace hyperlattice {

namespace {

/// Returns whether a writer has its own folder, named by its label. A writer without a label puts
/// its files into the run's folder.
bool has_folder(const Stage& writer) {
  const std::string type = writer.component->type();
  return writer.name != type.substr(type.find('.') + 1);
}

/// A writer and the text with which the names of all its files begin.
struct NamedWriter {
  const Stage* writer;
  std::string base;
};

/// Returns the writers that have an option `file`.
std::vector<NamedWriter> named_writers(const std::vector<const Stage*>& writers,
                                       const nlohmann::json& resolved) {
  std::vector<NamedWriter> named;
  for (const Stage* writer : writers) {
    const nlohmann::json::json_pointer place(writer->pointer + "/file");
    if (resolved.contains(place) && resolved[place].is_string())
      named.push_back({writer, resolved[place].get<std::string>()});
  }
  return named;
}

}  // namespace

bool OutputName::may_be(std::string_view name) const {
  if (frames == 0 || !name.starts_with(base)) return name == base;
  name.remove_prefix(base.size());
  if (name.starts_with('.')) return true;
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(name.data() + std::min<std::size_t>(1, name.size()),
                                            name.data() + name.size(), number);
  return name.starts_with('_') && error == std::errc() && end != name.data() + name.size() &&
         *end == '.' && static_cast<double>(number) < frames;
}

std::vector<OutputName> output_names(const Plan& plan) {
  std::vector<OutputName> names;
  const auto resolved = nlohmann::json::parse(plan.scene->resolved, nullptr, false);
  for (const auto& [writer, base] : named_writers(plan.scene->of(Family::writers), resolved))
    names.push_back({has_folder(*writer) ? writer->name : "", base, 1 + frames_of(plan, *writer)});
  for (const Stage* probe : plan.scene->of(Family::probes))
    names.push_back({"probes", probe->name + ".csv"});
  return names;
}

void check_file_names(const Scene& scene, Faults& faults) {
  const auto resolved = nlohmann::json::parse(scene.resolved, nullptr, false);
  const auto writers = scene.of(Family::writers);
  std::vector<NamedWriter> unlabelled = named_writers(writers, resolved);
  std::erase_if(unlabelled, [](const NamedWriter& one) { return has_folder(*one.writer); });
  for (const Stage* writer : writers) {
    if (!has_folder(*writer)) continue;
    const std::string& name = writer->name;
    if (std::find(std::begin(run_file_names), std::end(run_file_names), name) !=
        std::end(run_file_names))
      faults.add(writer->pointer + "/name", name,
                 fmt::format("a label that is no file of the run; those are {}",
                             fmt::join(run_file_names, ", ")));
    for (const auto& [other, base] : unlabelled) {
      if (name.starts_with(base) && name.find('.', base.size()) != std::string::npos)
        faults.add(writer->pointer + "/name", name,
                   fmt::format("a label that is no file of {} ({}), which are called {}...",
                               other->pointer, other->component->type(), base));
    }
  }
}

}  // namespace hyperlattice
