// Reads a whole scene from its text, with components from a catalogue: the host's, or a test's own.
#pragma once

#include <scene/scene.hpp>

namespace hyperlattice {

class Catalogue {
 public:
  virtual ~Catalogue() = default;
  /// The component of a type; null if there is none, then why_not says why, and refused whether
  /// that is the library's fault.
  virtual const Component* find(const std::string& type) = 0;
  virtual std::string why_not(const std::string& type) const = 0;
  virtual bool refused(const std::string& type) const = 0;
  virtual std::vector<std::string> known_types() const = 0;
  /// Whether a scene may name plugins of its own.
  virtual bool allows_scene_plugins() const { return true; }
  /// Adds the scene's "plugins"; one outcome an entry.
  virtual std::vector<SearchOutcome> add_scene_paths(const std::vector<std::string>& entries,
                                                     const std::filesystem::path& scene_folder) = 0;
};

/// Throws as read_scene does. `file` says where the scene stands; it is not opened.
std::unique_ptr<Scene> read_scene_text(std::string_view text, const std::filesystem::path& file,
                                       const std::vector<std::string>& settings,
                                       Catalogue& catalogue);

}  // namespace hyperlattice
