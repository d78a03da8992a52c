// The plugin host: finds the library of a type by its name, checks the gate before any of its code
// runs, loads it with immediate binding, and registers its components, all or none. Libraries are
// never unloaded.
#pragma once

#include <hyperlattice/component.hpp>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace hyperlattice {

/// A component and where it comes from. Lives as long as the process.
struct Component {
  ComponentInfo info;
  std::string plugin;          ///< "family.name": the file's name without its suffix
  std::string version;         ///< the plugin's
  std::filesystem::path path;  ///< of its library, absolute
  std::string type() const { return std::string(info.name); }
};

/// What became of one file or folder that was searched.
struct SearchOutcome {
  std::filesystem::path path;
  bool accepted = false;
  bool absent = false;  ///< no such file or folder; if neither accepted nor absent, it was refused
  std::string reason;   ///< a sentence: why it was refused, or what it gave
};

class Host {
 public:
  /// Folders are searched in this order: those of the scene's "plugins", HYPERLATTICE_PLUGIN_PATH,
  /// the install's. A missing folder is no error.
  explicit Host(std::vector<std::filesystem::path> scene_paths = {});

  /// Adds the entries of a scene's "plugins" (folders or libraries, relative to `scene_folder`),
  /// searched before all others. A library named directly is loaded at once, so that it may give
  /// any type. One outcome an entry: an absent one is the scene's fault, a refused one the
  /// library's.
  std::vector<SearchOutcome> add_scene_paths(const std::vector<std::string>& entries,
                                             const std::filesystem::path& scene_folder);

  /// The component of that type, loading only `<type>.so` unless a library named directly gave it.
  /// Null if there is none; then why_not(type) says why in a sentence.
  const Component* find(const std::string& type);
  std::string why_not(const std::string& type) const;
  /// Whether find(type) met a library of that name and refused it, rather than none.
  bool refused(const std::string& type) const { return refusals_.count(type) != 0; }

  /// Types that could be named, from file names alone; nothing is opened.
  std::vector<std::string> known_types() const;

  /// Loads everything on the search path; for `plugins` and `schema`.
  std::vector<const Component*> load_all();

  /// Every place searched so far and what became of it.
  const std::vector<SearchOutcome>& searched() const { return searched_; }

  /// Components loaded so far, in the order of loading.
  const std::vector<const Component*>& loaded() const { return order_; }

 private:
  SearchOutcome look_into(const std::filesystem::path& folder) const;
  const SearchOutcome& load(const std::filesystem::path& library, const std::string& expected_type);
  const Component* refuse(const std::string& type, const std::string& reason);
  /// Libraries called `<type>.so` in the folders; each file once, however many paths lead to it.
  std::vector<std::filesystem::path> libraries_of(const std::string& type) const;
  std::string dangling(const std::string& type);

  std::vector<std::filesystem::path> folders_;
  std::map<std::string, const Component*> components_;
  std::map<std::string, std::string> refusals_;  ///< type -> why its library was refused
  std::vector<const Component*> order_;
  std::vector<SearchOutcome> searched_;
};

}  // namespace hyperlattice
