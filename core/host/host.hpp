// The plugin host: finds the library of a type by its name, checks the gate before any of its code runs, loads it with immediate binding,
// and registers its components, all or none. Libraries are never unloaded.
#pragma once

#include <hyperlattice/component.hpp>

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hyperlattice {

/// A component and where it comes from. Lives as long as the process.
struct Component {
  ComponentInfo info;
  std::string plugin;               ///< "lattices.cubic": the file's name without its suffix
  std::string version;              ///< the plugin's
  std::filesystem::path path;       ///< of its library, absolute
  std::string type() const { return std::string(info.name); }
};

/// What became of one file or folder that was searched.
struct SearchOutcome {
  std::filesystem::path path;
  bool accepted = false;
  std::string reason;  ///< a sentence: why it was refused, or what it gave
};

class Host {
 public:
  /// Folders are searched in this order: those of the scene's "plugins", HYPERLATTICE_PLUGIN_PATH, the install's. A missing folder is no error.
  explicit Host(std::vector<std::filesystem::path> scene_paths = {});

  /// Adds the entries of a scene's "plugins" (folders or libraries, relative to `scene_folder`), searched before all others.
  void add_scene_paths(const std::vector<std::string>& entries, const std::filesystem::path& scene_folder);

  /// The component of that type, loading only `<type>.so`, or, if no folder has it, the libraries that a scene names directly.
  /// Null if there is none; then why_not(type) says why in a sentence.
  const Component* find(const std::string& type);
  std::string why_not(const std::string& type) const;

  /// Types that could be named, from file names alone; nothing is opened.
  std::vector<std::string> known_types() const;

  /// Loads everything on the search path; for `plugins` and `schema`.
  std::vector<const Component*> load_all();

  /// Every place searched so far and what became of it.
  const std::vector<SearchOutcome>& searched() const { return searched_; }

  /// Components loaded so far, in the order of loading.
  std::vector<const Component*> loaded() const;

 private:
  void load(const std::filesystem::path& library);

  std::vector<std::filesystem::path> folders_, libraries_;
  std::map<std::string, std::unique_ptr<Component>> components_;
  std::vector<const Component*> order_;
  std::vector<SearchOutcome> searched_;
};

}  // namespace hyperlattice
