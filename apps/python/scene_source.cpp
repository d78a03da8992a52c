#include "scene_source.hpp"

#include <plan/thread_choice.hpp>
#include <process/environment.hpp>

#include <nlohmann/json.hpp>

#include <cstdlib>
#include <mutex>

namespace hyperlattice::python {

namespace {

/// The host of all scenes that name no plugins of their own, for one HYPERLATTICE_PLUGIN_PATH.
struct SharedHost {
  std::string search_path;
  std::optional<Host> host;
};

std::unique_ptr<Scene> read(const SceneSource& source, Host& host) {
  return source.text ? read_scene_text(*source.text, host)
                     : read_scene(source.file, source.settings, host);
}

bool has_own_plugins(const Scene& scene) {
  const auto resolved = nlohmann::json::parse(scene.resolved);
  const auto plugins = resolved.find("plugins");
  return plugins != resolved.end() && !plugins->empty();
}

/// Reads a scene with a copy of the shared host. The copy replaces the shared host only if it is
/// still good for any scene: after a fault, the search must begin anew, because the user may build
/// a plugin that was missing.
std::unique_ptr<Scene> read(const SceneSource& source) {
  static auto& shared = *new SharedHost;  // components live until the process ends
  static std::mutex mutex;                // also because one library at a time may load
  const std::scoped_lock lock(mutex);
  const char* value = std::getenv("HYPERLATTICE_PLUGIN_PATH");
  const std::string search_path = value == nullptr ? "" : value;
  if (!shared.host || shared.search_path != search_path) {
    shared.host.emplace();
    shared.search_path = search_path;
  }
  Host host = *shared.host;
  std::unique_ptr<Scene> scene = read(source, host);
  if (!has_own_plugins(*scene)) shared.host = std::move(host);
  return scene;
}

}  // namespace

std::unique_ptr<Plan> plan_of(const SceneSource& source) {
  check_environment();
  const Threads threads = chosen_threads(source.threads);
  return make_plan(read(source), threads);
}

}  // namespace hyperlattice::python
