// A scene as Python names it, and its plan.
#pragma once

#include "function_set.hpp"

#include <plan/plan.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hyperlattice::python {

struct SceneSource {
  /// The scene's JSON. Files that it names are relative to the current folder. Empty: the scene is
  /// in `file`.
  std::optional<std::string> text;
  std::filesystem::path file;
  std::vector<std::string> settings;  ///< "/pointer=value", of a file
  int threads = 0;                    ///< 0: not given, see chosen_threads()
  /// The Python functions that the scene names; null: none. A FunctionScope must be around all that
  /// makes components of the scene.
  std::shared_ptr<FunctionSet> functions;
};

/// Plans a scene. Scenes without plugins of their own share one host, so that no library is
/// registered twice. Several threads may call it. Throws as read_scene() and make_plan() do.
std::unique_ptr<Plan> plan_of(const SceneSource& source);

}  // namespace hyperlattice::python
