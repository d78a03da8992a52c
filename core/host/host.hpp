// The plugin host. It finds the library of a type by its file name, checks the gate before any code
// of the library runs, loads it with immediate binding, and registers all of its components or
// none. Libraries are never unloaded.
#pragma once

#include <hyperlattice/component.hpp>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace hyperlattice {

/// A component and its plugin. Lives as long as the process.
struct Component {
  ComponentInfo info;
  std::string plugin;          ///< "family.name": the file's name without its suffix
  std::string version;         ///< version of the plugin
  std::filesystem::path path;  ///< absolute path of the library
  /// Returns the component's type, "<family>.<name>".
  std::string type() const { return std::string(info.name); }
};

/// The result of the search of one file or folder.
struct SearchOutcome {
  std::filesystem::path path;
  bool accepted = false;
  bool absent = false;  ///< true: no such file or folder; neither accepted nor absent: refused
  std::string reason;   ///< a sentence: the reason of the refusal, or the components found
};

/// Finds, loads and keeps the components of plugins.
class Host {
 public:
  /// Searches folders in this order: the scene's "plugins", HYPERLATTICE_PLUGIN_PATH, the folder of
  /// the installation. A missing folder is no error.
  explicit Host(std::vector<std::filesystem::path> scene_paths = {});

  /// Adds the entries of a scene's "plugins" (folders or libraries, relative to `scene_folder`)
  /// before all other places. Loads a library that is named directly at once, because it may have
  /// components of any type. Returns one outcome per entry: an absent one is an error of the scene,
  /// a refused one an error of the library.
  std::vector<SearchOutcome> add_scene_paths(const std::vector<std::string>& entries,
                                             const std::filesystem::path& scene_folder);

  /// Returns the component of a type. Loads only `<type>.so`, unless a library that was named
  /// directly has the component. Returns null if there is none; why_not(type) then gives the reason
  /// as a sentence.
  const Component* find(const std::string& type);
  std::string why_not(const std::string& type) const;
  /// Returns whether find(type) refused a library of that name (false: it found none).
  bool refused(const std::string& type) const { return refusals_.count(type) != 0; }

  /// Returns the types that a scene may name, from file names alone; opens no file.
  std::vector<std::string> known_types() const;

  /// Loads all libraries on the search path; for the commands `plugins` and `schema`.
  std::vector<const Component*> load_all();

  /// Returns the outcomes of all places searched so far.
  const std::vector<SearchOutcome>& searched() const { return searched_; }

  /// Returns the components loaded so far, in the order of loading.
  const std::vector<const Component*>& loaded() const { return order_; }

 private:
  SearchOutcome look_into(const std::filesystem::path& folder) const;
  const SearchOutcome& load(const std::filesystem::path& library, const std::string& expected_type);
  const Component* refuse(const std::string& type, const std::string& reason);
  /// Returns the libraries `<type>.so` in the folders; each file once, also if several paths lead
  /// to it.
  std::vector<std::filesystem::path> libraries_of(const std::string& type) const;
  std::string dangling(const std::string& type);

  std::vector<std::filesystem::path> folders_;
  std::map<std::string, const Component*> components_;
  std::map<std::string, std::string> refusals_;  ///< type -> why its library was refused
  std::vector<const Component*> order_;
  std::vector<SearchOutcome> searched_;
};

}  // namespace hyperlattice
